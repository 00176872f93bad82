#pragma once
/// Methods that a diagnosis has to beat, on the same cases, with answers of the same form (docs/validation.md,
/// "Simple methods").

#include <string>
#include <vector>

#include "validation/scoring/baselines/naming.h"
#include "validation/scoring/score.h"

namespace rollrig::validation {

struct BaselineMethod {
  const char* id;  // of its folder, answers-<id>
  const char* label;
  Naming (*name)(const LinearData&);  // none: names nothing, shrinks only
};

const std::vector<BaselineMethod>& all_baselines();

/// <set>/answers-<id>.
std::string baseline_folder(const std::string& set, const BaselineMethod& method);

/// A set by one method: verdict, probabilities, one cause at most, sizes, and how far it shrinks the gap on runs left
/// out. A method that names nothing has an unexplained set.
/// Errors   as LinearizedSet
/// Checked  tests/validation/scoring/baselines_of_sets_test.cpp
diagnosis::Diagnosis diagnose_by(const BaselineMethod& method, const measurements::MeasurementSet& set,
                                 const Settings& settings);

/// Figures of each baseline whose folder is in the validation set, by the same truth, known-cause fits and upper bound;
/// none where the truth was left out of the comparison. A method that names nothing is judged by its shrinkage alone.
/// Errors   InputError: as read_cases()
std::vector<BaselineScore> score_baselines(const ScoreOrder& order, const ScoreOptions& options);

/// Puts the baselines' figures into the score, and the best of them beside each figure of the diagnosis.
/// Checked  tests/validation/scoring/score_test.cpp
void put_beside(std::vector<BaselineScore> baselines, Score& score);

}  // namespace rollrig::validation
