#pragma once
/// The runs of a set as they are, and with mistakes undone.

#include <functional>
#include <utility>
#include <vector>

#include "diagnosis/checks/mistake_evidence.h"
#include "diagnosis/checks/plausibility.h"
#include "diagnosis/checks/repairs.h"

namespace rollrig::diagnosis {

/// A hypothesis on one run: nothing mistaken, or a mistake undone.
struct Trial {
  std::size_t mistake = 0;  // index
  double log_prior = 0.0;
  RunProducts products;
  double of_given = 0.0;  // logarithm of the likelihood of the given columns
  double worst = kLargestMisfit;
  double squares = 0.0;  // of the misfit
  bool is_simulated = false;
  bool is_plausible = false;
  bool is_far_better = true;  // than the run as it is

  bool is_possible() const { return is_simulated && is_far_better && is_plausible; }
  double calc_log_likelihood(const CommonParts& common, double size) const {
    constexpr double kRuledOut = -1e9;
    return is_simulated ? of_given + diagnosis::calc_log_likelihood(products, common, size) : kRuledOut;
  }
};

/// A run as it is, which lies further off than any other where it cannot be simulated, and with mistakes undone.
struct RunTrials {
  Trial none;
  std::vector<Trial> mistaken;
};

/// Every run as it is, and where it needs a look with each mistake undone. Keeps references to `set` and `baseline`.
class Candidates {
 public:
  /// `tells`: whether a mistake is considered in a run.
  Candidates(const measurements::MeasurementSet& set, const BaselineRuns& baseline, int threads,
             const std::function<bool(const Mistake&, std::size_t)>& tells);

  const std::vector<RunTrials>& runs() const { return runs_; }
  const std::vector<Mistake>& mistakes() const { return mistakes_; }
  std::size_t single_count() const { return singles_; }

 private:
  void judge_as_it_is(std::size_t r);
  /// Whether a run is so near to its simulation that no mistake could be that small. On the road noise hides it.
  bool is_near(std::size_t r) const;
  void try_out(const std::vector<std::pair<std::size_t, std::size_t>>& work, double prior_of_weight);
  /// Whether a mistake undone takes enough of the misfit, where effects show far above the noise.
  bool is_far_better(const Trial& tried, const Trial& none) const;
  /// Two wrong units in runs that one mistake alone does not explain.
  void add_pairs(const std::function<bool(const Mistake&, std::size_t)>& tells);
  /// On the road noise hides much: there a run in which any mistake is likely is tried with two.
  bool is_explained(std::size_t r) const;
  /// The single mistakes without which a run agrees best.
  std::vector<std::size_t> find_first_of_two(std::size_t r) const;
  /// Index of two mistakes, which are added to the list where they are not in it.
  std::size_t find_pair(std::size_t a, std::size_t b);

  const measurements::MeasurementSet& set_;
  const BaselineRuns& baseline_;
  int threads_;
  std::vector<Mistake> mistakes_;
  std::size_t singles_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  std::vector<RunTrials> runs_;
};

}  // namespace rollrig::diagnosis
