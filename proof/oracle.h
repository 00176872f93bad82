#pragma once
/// Races that know the truth, run after the seal is open: what can be achieved, and what happens without the truth.

#include "proof/bank.h"
#include "proof/run_bank.h"

namespace rollrig::proof {

enum class OracleRace {
  kAlone,    // the true effects alone: how far the gap can shrink
  kLeftOut,  // without the true effects: whether a neighbour is named instead
};

/// A task for each set with effects of the catalogue. `only` as in plan_race().
std::vector<Task> plan_oracle(const std::vector<Truth>& truths, OracleRace race, const std::vector<std::string>& only);

}  // namespace rollrig::proof
