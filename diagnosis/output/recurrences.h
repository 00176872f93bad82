#pragma once
/// Which effects come back from set to set, with the machine or with the tire.

#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/findings.h"

namespace rollrig::diagnosis {

/// What sets share.
enum class Shared { kMachine, kTire, kMachineAndTire };

/// An effect over all sets that share a machine, a tire, or both.
struct Recurrence {
  std::string effect;
  Shared shared = Shared::kMachine;
  std::string name;                 // of what is shared
  std::size_t sets = 0;             // that share it
  std::size_t named_in = 0;         // of these
  double probability = 0.0;         // that it acts in all of them
  std::optional<double> mean_size;  // weighted by the sets' uncertainties, in `unit`; none where named in no set
  double mean_size_sd = 0.0;
  std::string unit;
  std::optional<double> same_size_p;  // chance of sizes that differ this much if they are one; none below two sizes
};

/// Probability that an effect acts in all sets of a group, rather than in each by itself or not.
/// Equation  log odds = log(q/(1-q)) + sum over sets of log(b/(q b + 1 - q)), b = P/(1-P) (1-q)/q
/// Symbols   q prior probability of the effect, P its probability in a set; b Bayes factor of the set for it
/// Validity  sets with sessions of their own. Of one set P/(P + 1 - q), a half at most: one set cannot show that
///           an effect comes back
/// Checked   tests/diagnosis/fleet_test.cpp
double calc_recurrence_probability(const std::vector<double>& in_sets, double prior);

/// Which effects come back with the machine or with the tire. An effect is listed where it is named in one set at
/// least and acts with more than 80 % in all that share something, two sets at least: the widest such group of each
/// effect, the likeliest first. A set whose files are in doubt says nothing of any effect.
/// Source  Assumed: q = 0.02, about what a single effect has in a comparison of the whole catalog; 80 %, since what is
///         named once and not excluded elsewhere says little
std::vector<Recurrence> find_recurrences(const std::vector<FleetMember>& members);

}  // namespace rollrig::diagnosis
