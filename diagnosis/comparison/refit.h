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

/// Where a refit starts, and how far it goes.
struct RefitStart {
  Amplitudes amplitudes;  // of the discrepancy
  Eigen::VectorXd unknowns;
  int threads = 1;  // that share the runs of one evaluation
  int most_iterations = 50;
  const Fit* known = nullptr;  // of the same hypothesis: where it lies is not simulated again
};

/// Least squares of whitened residuals and priors under a discrepancy of given size, by Levenberg and Marquardt. A
/// hypothesis that cannot be simulated anywhere near its start comes back with an infinite cost. Own parameters stay
/// within their ranges; where one is on the limit of its range, all other unknowns are the best beside it.
/// Checked  tests/diagnosis/refit_test.cpp
Fit refit(const Model& model, const Discrepancy& discrepancy, const RefitStart& start);

}  // namespace rollrig::diagnosis
