#pragma once
/// The runs of a set as they are, and with mistakes undone, each compared with its simulation.

#include <functional>
#include <utility>
#include <vector>

#include "diagnosis/checks/mistake_evidence.h"
#include "diagnosis/checks/plausibility.h"
#include "diagnosis/checks/repairs.h"

namespace rollrig::diagnosis {

/// A hypothesis on one run: nothing mistaken, or a mistake undone.
struct Trial {
  std::size_t mistake = 0;  // index in Candidates::mistakes()
  double log_prior = 0.0;
  RunProducts products;
  double of_given = 0.0;          // logarithm of the likelihood of the given columns
  double worst = kLargestMisfit;  // of all channels (RunMisfit)
  double squares = 0.0;           // sum over the misfits
  bool is_simulated = false;
  bool is_plausible = false;
  bool is_far_better = true;  // than the run as it is

  bool is_possible() const { return is_simulated && is_far_better && is_plausible; }
  double calc_log_likelihood(const CommonParts& common, double size) const {
    constexpr double kRuledOut = -1e9;
    return is_simulated ? of_given + diagnosis::calc_log_likelihood(products, common, size) : kRuledOut;
  }
};

/// A run as it is, and with each mistake undone. If it cannot be simulated as it is, `none` has the largest misfit.
struct RunTrials {
  Trial none;
  std::vector<Trial> mistaken;
};

/// Every run as it is, and, unless it is near its simulation, with each mistake undone. Keeps references to `set` and
/// `baseline`.
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
  /// Whether a run is within 0.1 tolerances of its simulation, where no mistake could be that small. Never on the road,
  /// where noise hides mistakes.
  bool is_near(std::size_t r) const;
  void try_out(const std::vector<std::pair<std::size_t, std::size_t>>& work, double prior_of_weight);
  /// Whether undoing a mistake removes enough of the misfit (find_mistakes(), Validity).
  bool is_far_better(const Trial& tried, const Trial& none) const;
  /// Tries two wrong units in runs that one mistake alone does not explain.
  void add_pairs(const std::function<bool(const Mistake&, std::size_t)>& tells);
  /// Whether a run need not be tried with two mistakes: it is near its simulation, or is with one mistake undone. On
  /// the road, where noise hides much: no single mistake is likely in it.
  bool is_explained(std::size_t r) const;
  /// The single mistakes that a run agrees best without, the best six.
  std::vector<std::size_t> find_first_of_two(std::size_t r) const;
  /// Index of a pair of mistakes, which is added to the list if it is not in it.
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
