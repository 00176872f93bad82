#pragma once
/// How likely each mistake is in each run.

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "diagnosis/checks/mistake_trials.h"

namespace rollrig::diagnosis {

/// Probabilities of the mistakes in each run; what is missing to 1 is that nothing was mistaken. Summed over the
/// unknown size, and over whether the runs have parts in common. Equation: find_mistakes(). Keeps a reference to
/// `candidates`.
class Posterior {
 public:
  explicit Posterior(const Candidates& candidates);

  /// By the index of the mistake.
  const std::map<std::size_t, double>& of_run(std::size_t r) const { return probability_[r]; }

 private:
  /// Logarithms, and what gets their share.
  using Parts = std::vector<std::pair<double, std::function<void(double)>>>;

  /// In each run nothing, one mistake or two, whatever it was in the other runs.
  void add_by_run(const CommonParts& common, double log, double size, Parts& parts);
  /// The same mistake in all runs.
  void add_in_all(std::size_t mistake, Parts& parts);

  const Candidates& candidates_;
  std::vector<std::map<std::size_t, double>> probability_;
};

}  // namespace rollrig::diagnosis
