#pragma once
/// Input quantities that several procedures have alike.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// An error of which no file says anything: rectangular, with an assumed half-width that `limits` tells in words.
UncertainInput make_assumed_limit(const std::string& name, const std::string& key, double value, double half_width,
                                  const std::string& limits);

/// Errors whose common standard deviation was estimated from residuals: `count` inputs of standard deviation 1, and
/// after them one that says by how much that standard deviation may be off. All have one name, so that they are one
/// line of a budget.
/// Equation  e_i = s k z_i, k = sqrt(nu/chi2_nu): together, the e_i have Student's t distribution of several dimensions
/// Symbols   s estimated standard deviation, nu its degrees of freedom, chi2_nu a chi-square variable
/// Source    JCGM 102:2011 5.3.2 (joint t distribution of estimates with one covariance from residuals). Second-hand
/// Checked   tests/estimation/uncertainty_test.cpp
std::vector<UncertainInput> make_scatter_inputs(std::size_t count, double degrees_freedom, const std::string& name,
                                                const std::string& source);

/// The errors in units of their standard deviation, k z_i, from the values of all inputs of a model. `first` is the
/// place of the first of `count`; the inputs are count + 1.
std::vector<double> take_scatter(const std::vector<double>& inputs, std::size_t first, std::size_t count);

/// L with L L^T = covariance, lower triangular; rows of numbers without variance are 0.
Eigen::MatrixXd calc_covariance_root(const Eigen::MatrixXd& covariance);

}  // namespace rollrig::estimation
