#pragma once
/// A fit to first order, and what it leaves: for questions that are linear in what is added to it.

#include <Eigen/Cholesky>

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// Whitened by sensors and discrepancy: what a fit leaves at its best unknowns, and how those could still move.
/// Equation  residual = (1 - J M^-1 J^T) r, unknowns = -M^-1 J^T r, M = 1 + J^T J; a column x of unit size has the
///           score x.residual, whose variance is |x|^2 - (J^T x)^T M^-1 (J^T x)
/// Symbols   r whitened residual at the priors' middles, J its derivatives by the fit's unknowns, in prior units
/// Source    generalized least squares with normal priors
/// Checked   tests/diagnosis/locations_test.cpp
struct LinearFit {
  LinearFit(const Discrepancy& discrepancy, const Candidate& candidate);

  /// Whitens block values in SI units, in place.
  template <class Columns>
  void whiten(Columns& columns) const {
    diagnosis::whiten(discrepancy.set(), columns);
    discrepancy.whiten(amplitudes, columns);
  }

  /// How an added difference of block means (SI units) of unit size agrees with what is left.
  struct Score {
    double along = 0.0;     // x.residual
    double variance = 0.0;  // of it: what of the difference the fit's unknowns cannot take
  };
  Score calc_score(Eigen::VectorXd difference) const;

  const Discrepancy& discrepancy;
  Amplitudes amplitudes;
  RowMatrix jacobian;
  Eigen::MatrixXd curvature;  // M
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd unknowns;  // best under these amplitudes
  Eigen::VectorXd residual;  // there
};

}  // namespace rollrig::diagnosis
