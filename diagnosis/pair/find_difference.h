#pragma once
/// From a comparison of hypotheses on joined sets to the effects in which the machines differ.

#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "include/rollrig/machine_pair.h"

namespace rollrig::diagnosis {

/// Effects that make the machines differ under a hypothesis: those of one machine alone, and curvature_exponent where
/// the drums are of different diameters. What acts on both machines makes no difference.
std::vector<std::string> list_differing(const Study& study, const std::vector<std::string>& terms);

/// Probabilities of "agree", "unknown" and every effect of one machine; "agree" are all hypotheses in which nothing
/// makes a difference, "unknown" those with a free discrepancy.
std::map<std::string, double> find_pair_probabilities(const Study& study, const Comparison& comparison);

/// A cause and the candidate after which it is named.
struct NamedDifference {
  rollrig::MachineDifference cause;
  const Candidate* lead = nullptr;
};

/// Causes, the most probable first: hypotheses that differ in the same effects belong together, whichever machine has
/// them. Those whose expected log Bayes factor against the likeliest is below 3 on these sets cannot be told from it.
/// Checked  tests/diagnosis/machine_pair_test.cpp
std::vector<NamedDifference> find_differences(const Study& study, const Comparison& comparison);

/// "agree" where that is at least as probable as "unknown" and as the first cause, or where the first cause is of more
/// than three effects, as each of them; else unexplained if "unknown" is at least as probable as the first cause.
rollrig::PairVerdict find_pair_verdict(const std::map<std::string, double>& probability,
                                       const std::vector<NamedDifference>& causes);

}  // namespace rollrig::diagnosis
