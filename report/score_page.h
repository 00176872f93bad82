#pragma once
/// The page of `rollrig blind score`.

#include "report/page.h"
#include "validation/scoring/score.h"

namespace rollrig::report {

/// Every figure beside its target and the best baseline, shares with their intervals, reliability of the stated
/// probabilities, tallies by effect, campaign and size, confusions, and what was missed.
Page make_score_page(const proof::Score& score, const std::string& bank);

}  // namespace rollrig::report
