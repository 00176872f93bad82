#pragma once
/// The best unknowns of a hypothesis.

#include "diagnosis/comparison/discrepancy.h"

namespace rollrig::diagnosis {

/// A hypothesis at its best unknowns, and what follows there.
struct Fit {
  Hypothesis hypothesis;
  Eigen::VectorXd unknowns;   // prior units
  Eigen::VectorXd simulated;  // block means, SI, without offsets
  Eigen::VectorXd residuals;  // whitened by the sensors
  RowMatrix jacobian;         // of those
  double cost = 0.0;          // half of chi2 with priors, under the discrepancy's amplitudes
};

/// Least squares of whitened residuals and priors under a discrepancy of given amplitudes, by Levenberg and Marquardt.
/// `threads` shares the runs of one evaluation. A hypothesis that cannot be simulated anywhere near its start comes
/// back with an infinite cost.
Fit refit(const Model& model, const Discrepancy& discrepancy, const Amplitudes& amplitudes,
          const Eigen::VectorXd& start, int threads, int most_iterations = 50);

}  // namespace rollrig::diagnosis
