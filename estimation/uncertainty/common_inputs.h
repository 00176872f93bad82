#pragma once
/// Input quantities that several procedures have alike.

#include <cstddef>
#include <string>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// An error of which no file says anything: rectangular, with an assumed half-width that `limits` tells in words.
UncertainInput make_assumed_input(const std::string& name, const std::string& key, double value, double half_width,
                                  const std::string& limits);

/// Errors whose common standard deviation was estimated from residuals: `count` inputs of standard deviation 1, and
/// after them one that scales them all. All have one name, so that they are one line of a budget.
/// Equation  e_i = s k z_i, k = sqrt(nu/chi2_nu): the e_i have a multivariate t distribution
/// Symbols   s estimated standard deviation, nu its degrees of freedom, chi2_nu a chi-square variable of nu degrees of
///           freedom, z_i independent standard normal variables
/// Source    JCGM 102:2011, 5.3.2. Not read
/// Checked   tests/estimation/uncertainty_test.cpp
std::vector<UncertainInput> make_scatter_inputs(std::size_t count, double degrees_freedom, const std::string& name,
                                                const std::string& source);

/// Puts an error of another name into the pool of such inputs: its standard deviation is from the same estimate. Its
/// value is to be multiplied by the scale k as well, which take_scale() gives.
void share_scatter(const std::vector<UncertainInput>& scatter, UncertainInput& input);
/// k of such inputs, of which the first is at `first`.
double take_scale(const std::vector<double>& inputs, std::size_t first, std::size_t count);

/// The errors in units of their standard deviation, k z_i, from the values of all inputs of a model. `first` is the
/// place of the first of `count`; the inputs are count + 1.
std::vector<double> take_scatter(const std::vector<double>& inputs, std::size_t first, std::size_t count);

}  // namespace rollrig::estimation
