#pragma once
/// The optimum of a tire fit and how sharp it is.

#include <Eigen/Core>
#include <vector>

#include "estimation/tire_fit/drum_residuals.h"
#include "include/rollrig/progress.h"

namespace rollrig::estimation {

/// The unknowns at the least sum of squares, within the bounds of the parameters. The search begins at `first`, one
/// value [SI] for each parameter.
/// Errors  RunFailure: no convergence
std::vector<double> minimize(const DrumResiduals& residuals, const std::vector<double>& first,
                             const Progress& progress);

/// Covariance of the unknowns at the optimum: the inverse of J^T J. The columns of J are scaled to unit length first:
/// in SI units a heat capacity's is so much shorter than the others' that it would pass for a direction that the data
/// do not decide.
/// Errors  RunFailure: data and priors leave a direction undecided
Eigen::MatrixXd find_covariance(const DrumResiduals& residuals, const std::vector<double>& unknowns);

}  // namespace rollrig::estimation
