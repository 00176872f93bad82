#pragma once
/// The baselines' figures beside those of the diagnosis.

#include "validation/scoring/score.h"

namespace rollrig::validation {

/// Figures of each baseline whose folder is in the validation set, by the same truth, known-cause fits and upper bound;
/// none where the truth was left out of the comparison. A method that names nothing is judged by its shrinkage alone.
/// Errors   InputError: as read_cases()
std::vector<BaselineScore> score_baselines(const ScoreOrder& order, const ScoreOptions& options);

/// Puts the baselines' figures into the score, and the best of them beside each figure of the diagnosis.
/// Checked  tests/validation/scoring/score_test.cpp
void put_beside(std::vector<BaselineScore> baselines, Score& score);

}  // namespace rollrig::validation
