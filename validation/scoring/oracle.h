#pragma once
/// Races that know the truth, run after the seal is open: what can be achieved, and what happens without the truth.

#include <map>

#include "validation/scoring/bank.h"
#include "validation/scoring/run_bank.h"

namespace rollrig::proof {

enum class OracleRace {
  kAlone,    // the true effects alone: how far the gap can shrink
  kLeftOut,  // without the true effects and their twins: whether a neighbor is named instead
};

/// Effects by set.
using Twins = std::map<std::string, std::vector<std::string>>;

/// What a set's own data do not tell from the truth: the others of the set that its answer names, where the truth is in
/// that, of whatever size.
Twins find_twins(const std::vector<Truth>& truths, const std::string& answers);

/// Adds to the twins of each set all effects that the catalog calls confusable with the true ones, either way.
void add_confusable(const std::vector<Truth>& truths, Twins& twins);

/// A task for each set with effects of the catalog. `only` as in plan_race(); `twins` are left out with the truth.
std::vector<Task> plan_oracle(const std::vector<Truth>& truths, OracleRace race, const std::vector<std::string>& only,
                              const Twins& twins = {});

}  // namespace rollrig::proof
