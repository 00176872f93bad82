#include "estimation/tire_fit/fit_solution.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "estimation/quiet_solver.h"
#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

/// The residuals as Ceres takes them: one block of unknowns.
class ResidualFunction : public ceres::CostFunction {
 public:
  explicit ResidualFunction(const DrumResiduals& residuals) : residuals_(residuals) {
    set_num_residuals(static_cast<int>(residuals.residual_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(residuals.unknown_count()));
  }
  bool Evaluate(double const* const* unknowns, double* out, double** jacobians) const override {
    try {
      residuals_.evaluate(unknowns[0], out, jacobians != nullptr ? jacobians[0] : nullptr);
    } catch (const RunFailure&) {  // no tire: the step that tried it is taken back
      return false;
    }
    return std::all_of(out, out + residuals_.residual_count(), [](double r) { return std::isfinite(r); });
  }

 private:
  const DrumResiduals& residuals_;
};

/// Tells the caller and the log of each iteration.
class FollowIterations : public ceres::IterationCallback {
 public:
  explicit FollowIterations(Progress progress) : progress_(std::move(progress)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& at) override {
    spdlog::debug("fit: iteration {}, half chi2 {:.6g}, largest gradient {:.2g}", at.iteration, at.cost,
                  at.gradient_max_norm);
    if (progress_) progress_(std::nan(""), fmt::format("iteration {}", at.iteration));
    return ceres::SOLVER_CONTINUE;
  }

 private:
  Progress progress_;
};

}  // namespace

std::vector<double> minimize(const DrumResiduals& residuals, const std::vector<double>& first,
                             const Progress& progress) {
  std::vector<double> found = residuals.start();
  std::copy(first.begin(), first.end(), found.begin());
  ceres::Problem problem;
  problem.AddResidualBlock(new ResidualFunction(residuals), nullptr, found.data());
  for (std::size_t i = 0; i < residuals.parameters().size(); ++i) {
    const FreeParameter& parameter = residuals.parameters()[i];
    const int at = static_cast<int>(i);
    if (std::isfinite(parameter.lower_SI)) problem.SetParameterLowerBound(found.data(), at, parameter.lower_SI);
    if (std::isfinite(parameter.upper_SI)) problem.SetParameterUpperBound(found.data(), at, parameter.upper_SI);
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 300;  // Assumed: enough for guesses that are far off
  solver.function_tolerance = 1e-10;
  solver.logging_type = ceres::SILENT;
  quiet_solver();  // what it says of a step or of the data, an error below says
  FollowIterations follow(progress);
  solver.callbacks.push_back(&follow);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) throw RunFailure("the fit does not converge: " + summary.message);
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
