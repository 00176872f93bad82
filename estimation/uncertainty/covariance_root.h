#pragma once
/// Root of a covariance, for draws of correlated numbers.

#include <Eigen/Core>

namespace rollrig::estimation {

/// L with L L^T = covariance, lower triangular; rows of numbers without variance are 0.
/// Validity  a covariance matrix, also a singular one
/// Checked   tests/estimation/uncertainty_test.cpp
Eigen::MatrixXd calc_covariance_root(const Eigen::MatrixXd& covariance);

}  // namespace rollrig::estimation
