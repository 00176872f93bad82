#pragma once
/// The joint normal prior of the numbers that a fit may move.

#include <Eigen/Core>
#include <vector>

#include "estimation/parameters.h"
#include "models/tire/correlation.h"

namespace rollrig::estimation {

/// Enters each correlation into both parameters. A pair without two parameters that have a prior is ignored.
void put_correlations(const std::vector<models::CorrelatedPair>& pairs, std::vector<FreeParameter>& parameters);

/// Lower triangular factor of the correlation matrix of the parameters that have a prior, in their order; exactly the
/// identity where all are independent.
/// Equation  x = x0 + s L u, R = L L^T
/// Symbols   x numbers in SI units, x0 their prior means (the values of the files), s their standard deviations
/// (diagonal); u independent, standard
///           normal; R correlation matrix of x
/// Source    the Cholesky factor of a multivariate normal distribution
/// Errors    std::invalid_argument: the correlations are not positive definite
/// Checked   tests/estimation/normal_prior_test.cpp
Eigen::MatrixXd calc_prior_factor(const std::vector<FreeParameter>& parameters);

}  // namespace rollrig::estimation
