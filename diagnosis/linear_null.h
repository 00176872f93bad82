#pragma once
/// The fitted baseline to first order, and what it leaves: for questions that are linear in what is added.

#include <Eigen/Cholesky>

#include "diagnosis/race.h"

namespace rollrig::diagnosis {

/// Whitened by sensors and remainder: what the baseline leaves at its best unknowns, and how those could still move.
/// Equation  residual = (1 - J M^-1 J^T) r, unknowns = -M^-1 J^T r, M = 1 + J^T J; a column x of unit size has the
///           score x.residual, whose variance is |x|^2 - (J^T x)^T M^-1 (J^T x)
/// Symbols   r whitened residual at the priors' middles, J its derivatives by base parameters and offsets, in prior
///           units
/// Source    generalised least squares with normal priors
/// Checked   tests/diagnosis/locations_test.cpp
struct LinearNull {
  LinearNull(const Remainder& remainder, const Contender& null);

  /// Whitens block values in SI units, in place.
  void whiten(RowMatrix& columns) const;

  const Remainder& remainder;
  Amplitudes amplitudes;
  RowMatrix jacobian;
  Eigen::MatrixXd curvature;  // M
  Eigen::VectorXd unknowns;   // best under these amplitudes
  Eigen::VectorXd residual;   // there
};

}  // namespace rollrig::diagnosis
