#pragma once
/// The page of `rollrig blind score`.

#include "proof/score.h"
#include "report/page.h"

namespace rollrig::report {

/// Every figure beside its target and the best baseline, shares with their intervals, reliability of the stated
/// probabilities, tallies by effect, campaign and size, confusions, and what was missed.
Page make_score_page(const proof::Score& score, const std::string& bank);

}  // namespace rollrig::report
