#pragma once
/// Fits that know the cause, made once the truth is open: what can be achieved, and what happens without the truth.

#include <map>

#include "validation/scoring/run_cases.h"
#include "validation/scoring/truth.h"

namespace rollrig::validation {

enum class KnownCause {
  kAlone,    // the true effects alone: how far the gap can shrink
  kLeftOut,  // without the true effects and their twins: whether a neighbor is named instead
};

/// Effects by case.
using Twins = std::map<std::string, std::vector<std::string>>;

/// What a case's own data do not tell from the truth: the others of the set that its answer names, where the truth is
/// in that, of whatever size.
Twins find_twins(const std::vector<Truth>& truths, const std::string& answers);

/// Adds to the twins of each case all effects that the catalog calls confusable with the true ones, either way.
void add_confusable(const std::vector<Truth>& truths, Twins& twins);

/// A task for each case with effects of the catalog. `only` as in plan_tasks(); `twins` are left out with the truth.
std::vector<Task> plan_known_cause(const std::vector<Truth>& truths, KnownCause cause,
                                   const std::vector<std::string>& only, const Twins& twins = {});

}  // namespace rollrig::validation
