#include "estimation/tire_fit/fit_solution.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "estimation/least_squares/least_squares.h"
#include "sim/core/error.h"

namespace rollrig::estimation {
std::vector<double> minimize(const DrumResiduals& residuals, const std::vector<double>& first,
                             const Progress& progress) {
  std::vector<double> found = residuals.start();
  std::copy(first.begin(), first.end(), found.begin());
  LeastSquaresProblem problem;
  problem.residuals = residuals.residual_count();
  problem.evaluate = [&residuals](const double* unknowns, double* out, double* jacobian) {
    try {
      residuals.evaluate(unknowns, out, jacobian);
    } catch (const RunFailure&) {  // no tire: the step that tried it is taken back
      return false;
    }
    return std::all_of(out, out + residuals.residual_count(), [](double r) { return std::isfinite(r); });
  };
  for (const FreeParameter& parameter : residuals.parameters()) {
    problem.lower.push_back(parameter.lower_SI);
    problem.upper.push_back(parameter.upper_SI);
  }
  problem.follow = [&progress](int iteration, double half_sum, double largest_gradient) {
    spdlog::debug("fit: iteration {}, half chi2 {:.6g}, largest gradient {:.2g}", iteration, half_sum,
                  largest_gradient);
    if (progress) progress(std::nan(""), fmt::format("iteration {}", iteration));
  };
  LeastSquaresOptions options;
  options.most_iterations = 300;  // Assumed: enough for guesses that are far off
  options.function_tolerance = 1e-10;
  const LeastSquaresResult result = minimize_squares(problem, options, found);
  if (!result.has_converged) throw RunFailure("the fit does not converge: " + result.message);
  return found;
}

Eigen::MatrixXd find_covariance(const DrumResiduals& residuals, const std::vector<double>& unknowns) {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto count = static_cast<Eigen::Index>(residuals.unknown_count());
  std::vector<double> at_best(residuals.residual_count());
  RowMatrix jacobian(static_cast<Eigen::Index>(residuals.residual_count()), count);
  residuals.evaluate(unknowns.data(), at_best.data(), jacobian.data());
  const Eigen::VectorXd lengths = jacobian.colwise().norm();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  constexpr double kUndecided = 1e-7;  // Assumed: of unit columns, what rounding leaves of a direction without effect
  qr.setThreshold(kUndecided);
  if (lengths.minCoeff() > 0.0) qr.compute(jacobian * lengths.cwiseInverse().asDiagonal());
  if (!(lengths.minCoeff() > 0.0) || !lengths.allFinite() || qr.rank() < count) {
    throw RunFailure("the fit has no covariance: the data do not decide the parameters");
  }
  const Eigen::MatrixXd r = qr.matrixR().topRows(count).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse =
      qr.colsPermutation() * r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd scaled = lengths.cwiseInverse().asDiagonal() * inverse;
  return scaled * scaled.transpose();
}

}  // namespace rollrig::estimation
