#pragma once
/// The page of `rollrig_validation score`.

#include "report/page.h"
#include "validation/scoring/score.h"

namespace rollrig::validation {

/// Every figure beside its target and the best baseline, shares with their intervals, reliability of the stated
/// probabilities, tallies by effect, campaign and size, confusions, and what was missed.
report::Page make_score_page(const Score& score, const std::string& set);

}  // namespace rollrig::validation
