#pragma once
/// How likely each mistake is in each run.

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "diagnosis/checks/mistake_trials.h"

namespace rollrig::diagnosis {

/// Probabilities of the mistakes in each run; the rest to 1 is the probability that nothing was mistaken. Summed over
/// the unknown size, with and without common parts of the runs. Equation: find_mistakes(). Keeps a reference to
/// `candidates`.
class Posterior {
 public:
  explicit Posterior(const Candidates& candidates);

  /// By the index of the mistake.
  const std::map<std::size_t, double>& of_run(std::size_t r) const { return probability_[r]; }

 private:
  /// Summands of the total probability: the logarithm of each, and a function that adds its share of the total to the
  /// probabilities of the mistakes. (Not parts of a simulation, as CommonParts.)
  using Parts = std::vector<std::pair<double, std::function<void(double)>>>;

  /// The hypothesis that each run has nothing, one mistake or two, independently of the other runs.
  void add_by_run(const CommonParts& common, double log, double size, Parts& parts);
  /// The hypothesis that all runs have the same mistake.
  void add_in_all(std::size_t mistake, Parts& parts);

  const Candidates& candidates_;
  std::vector<std::map<std::size_t, double>> probability_;
};

}  // namespace rollrig::diagnosis
