#pragma once
/// What the options of road loads may be.

#include "rollrig/fit_options.h"
#include "rollrig/road_load_options.h"

namespace rollrig {

/// Each throws InputError, which names a member as the option of the command line.
void require_valid(const RoadLoadFitOptions& options);
void require_valid(const RoadLoadProcedureOptions& options);
void require_valid(const DefaultRoadLoadOptions& options);

}  // namespace rollrig
