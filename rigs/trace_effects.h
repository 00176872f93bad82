#pragma once
/// Port "trace": what effects do to the measured channels after a run.

#include "models/corner.h"
#include "sim/recording.h"

namespace rollrig::rigs {

/// Runs the trace functions of the effects that are on over the channels of a recording.
template <class S>
void apply_trace_effects(const models::Corner<S>& corner, sim::Recording<S>& recording);

}  // namespace rollrig::rigs
