#pragma once
/// The generator's items as those of a campaign.

#include <string>

#include "cli/progress.h"
#include "validation/generator/validation_set.h"

namespace rollrig::validation {

/// Carries the items out as campaigns::carry_out_each() does: as many at a time as there are threads (0: cores), with
/// the same result to the bit. `what` are the items, for people: "cases".
generator::MakeItems make_by_campaign(int threads, cli::ProgressLine& line, std::string what);

}  // namespace rollrig::validation
