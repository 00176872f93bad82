#pragma once
/// A set whose tire file does not say how well its numbers are known, compared under both beliefs about them.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "include/rollrig/findings.h"

namespace rollrig::diagnosis {

/// A comparison of all hypotheses under one belief about the tire's numbers.
struct Belief {
  std::unique_ptr<Study> study;
  Comparison comparison;
};

/// The likelier belief, on which all further findings rest, and the other.
struct Beliefs {
  Belief likelier;
  double weight = 1.0;          // its probability
  std::optional<Belief> other;  // where it was tried
};

/// Compares under TireBelief::kIdentified, and where the file leaves the origin of the tire's numbers open and these
/// numbers move by more than 1.5 of their usual uncertainties, without a cause or with the likeliest, also under
/// TireBelief::kClass. The evidence of all hypotheses decides between the beliefs: wide priors cost evidence where the
/// numbers are right.
/// Equation  weight = q Z_class/(q Z_class + (1 - q) Z_identified), Z summed over all hypotheses with their priors
/// Symbols   q = 0.99 (Assumed)
/// Errors    RunFailure: the baseline cannot be fitted
/// Checked   tests/diagnosis/guessed_tire_test.cpp
Beliefs compare_beliefs(const measurements::MeasurementSet& measured, const StudySettings& settings);

/// Averages probabilities of hypotheses and causes over both beliefs.
void average_over_beliefs(const Beliefs& beliefs, std::map<std::string, double>& probability,
                          std::vector<rollrig::Cause>& causes);

/// Likewise a probability that a function takes from a belief.
double average_of(const Beliefs& beliefs, const std::function<double(const Belief&)>& find);

}  // namespace rollrig::diagnosis
