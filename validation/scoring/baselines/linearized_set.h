#pragma once
/// A measured set to first order: the baselines' data, and what the simulator makes of the effects that they choose.

#include "diagnosis/findings/gap.h"
#include "validation/scoring/answer.h"
#include "validation/scoring/baselines/linear_data.h"

namespace rollrig::validation {

/// An effect at one size and shape.
struct TriedEffect {
  diagnosis::SignedTerm term;
  Eigen::VectorXd own;     // prior units
  Eigen::VectorXd change;  // by it to the baseline as calibrated, whitened by the sensors
};

/// A signature in a fit.
struct ChosenEffect {
  TriedEffect tried;
  double amplitude = 0.0;  // 1: as tried
  double sd = 0.0;
};

/// Data are those that the diagnosis compares: the same blocks without what stuck sensors read, the same priors of
/// base parameters and offsets, the same effects in the comparison. Noise is that of the sensors, without model error.
class LinearizedSet {
 public:
  /// Errors  InputError: a file lacks what the set's kind needs; nothing measured. RunFailure: the baseline as
  ///         calibrated cannot be simulated
  LinearizedSet(const measurements::MeasurementSet& measured, const Settings& settings);
  LinearizedSet(const LinearizedSet&) = delete;
  LinearizedSet& operator=(const LinearizedSet&) = delete;

  /// Each effect at the size and shape that diagnosis::screen() asks for, for each sign or side of its prior:
  /// simulated, so that effects without a first order are seen. Left out where that cannot be simulated.
  std::vector<TriedEffect> try_effects() const;
  LinearData project(const std::vector<TriedEffect>& tried) const;

  /// The gap by the diagnosis' own measure: with each run left out, one step of all unknowns from these sizes, and the
  /// run simulated. Of effects chosen twice the first counts; none: no cause.
  diagnosis::Gap find_gap(const std::vector<ChosenEffect>& chosen,
                          const diagnosis::BlackBox& black_box = diagnosis::subtract_black_box) const;

 private:
  diagnosis::Candidate expand(const std::vector<ChosenEffect>& chosen) const;

  diagnosis::Study study_;  // its discrepancy of no size: the fits' linear algebra asks for one
};

/// Size of a chosen effect: its distance from doing nothing goes by the amplitude.
diagnosis::ParameterEstimate estimate_size(const ChosenEffect& chosen);

}  // namespace rollrig::validation
