#include "diagnosis/comparison/refit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollrig::diagnosis {
namespace {

/// Whitened residuals, then the unknowns themselves, whose priors are standard normal.
class WhitenedResiduals : public ceres::CostFunction {
 public:
  WhitenedResiduals(const Model& model, const Discrepancy& discrepancy, const RefitStart& start)
      : model_(model), discrepancy_(discrepancy), amplitudes_(start.amplitudes), threads_(start.threads) {
    set_num_residuals(static_cast<int>(model.residual_count() + model.unknown_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.unknown_count()));
  }

  bool Evaluate(double const* const* parameters, double* out, double** jacobians) const override {
    const Eigen::Index unknowns = to_index(model_.unknown_count());
    const Eigen::Index rows = to_index(model_.residual_count());
    const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(parameters[0], unknowns);
    const bool derive = jacobians != nullptr && jacobians[0] != nullptr;
    Eigen::VectorXd residuals;
    RowMatrix jacobian;
    if (!model_.evaluate(u, threads_, residuals, derive ? &jacobian : nullptr)) return false;
    const Eigen::VectorXd whitened = residuals;
    discrepancy_.whiten(amplitudes_, residuals);
    Eigen::Map<Eigen::VectorXd>(out, rows) = residuals;
    Eigen::Map<Eigen::VectorXd>(out + rows, unknowns) = u;
    if (derive) {
      last_ = {u, whitened, jacobian};
      discrepancy_.whiten(amplitudes_, jacobian);
      Eigen::Map<RowMatrix> all(jacobians[0], rows + unknowns, unknowns);
      all.topRows(rows) = jacobian;
      all.bottomRows(unknowns).setIdentity();
    }
    return true;
  }

  /// Whitened residuals and their derivatives where they were last derived.
  struct Derived {
    Eigen::VectorXd unknowns;
    Eigen::VectorXd residuals;
    RowMatrix jacobian;
  };
  const Derived& last() const { return last_; }

 private:
  const Model& model_;
  const Discrepancy& discrepancy_;
  const Amplitudes& amplitudes_;
  int threads_;
  mutable Derived last_;
};

/// Whether a fit stopped short of its best because of a range: near the end of one, a step of Gauss and Newton goes
/// beyond it, or promises a better fit that steps of Levenberg and Marquardt did not reach, since they ended outside.
bool is_held_up_by_range(const Model& model, const Discrepancy& discrepancy, const RefitStart& start, const Fit& fit) {
  constexpr double kNear = 0.5;             // Assumed: prior units
  constexpr double kWorthGoing_nats = 0.1;  // Assumed: less decides nothing
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const PriorBounds bounds = model.own_parameters()[i].bounds();
    const double u = fit.unknowns[to_index(i)];
    if (std::min(bounds.upper - u, u - bounds.lower) < kNear) near.push_back(i);
  }
  if (near.empty()) return false;
  RowMatrix jacobian = fit.jacobian;
  Eigen::VectorXd residuals = fit.residuals;
  discrepancy.whiten(start.amplitudes, jacobian);
  discrepancy.whiten(start.amplitudes, residuals);
  const Eigen::Index n = jacobian.cols();
  const Eigen::VectorXd gradient = jacobian.transpose() * residuals + fit.unknowns;
  const Eigen::VectorXd step =
      (jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(n, n)).llt().solve(-gradient);
  if (-0.5 * gradient.dot(step) > kWorthGoing_nats) return true;
  return std::any_of(near.begin(), near.end(), [&](std::size_t i) {
    const PriorBounds bounds = model.own_parameters()[i].bounds();
    const double aim = fit.unknowns[to_index(i)] + step[to_index(i)];
    return aim > bounds.upper || aim < bounds.lower;
  });
}

void set_ranges(const Model& model, ceres::Problem& problem, double* unknowns) {
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const PriorBounds bounds = model.own_parameters()[i].bounds();
    const auto index = static_cast<int>(i);
    if (std::isfinite(bounds.lower)) problem.SetParameterLowerBound(unknowns, index, bounds.lower);
    if (std::isfinite(bounds.upper)) problem.SetParameterUpperBound(unknowns, index, bounds.upper);
  }
}

/// Minimizes, and derives the residuals where it stops. False where that is no solution; then the cost is infinite.
bool solve(const ceres::Solver::Options& options, ceres::Problem& problem, const WhitenedResiduals& residuals,
           const Model& model, const RefitStart& start, Fit& fit) {
  fit.cost = std::numeric_limits<double>::infinity();
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  if (residuals.last().unknowns.size() > 0 && residuals.last().unknowns == fit.unknowns) {
    fit.residuals = residuals.last().residuals;
    fit.jacobian = residuals.last().jacobian;
  } else if (!model.evaluate(fit.unknowns, start.threads, fit.residuals, &fit.jacobian)) {
    return false;
  }
  fit.cost = summary.final_cost;
  return true;
}

}  // namespace

Fit refit(const Model& model, const Discrepancy& discrepancy, const RefitStart& start) {
  Fit fit;
  fit.hypothesis = model.hypothesis();
  fit.unknowns = start.unknowns;
  fit.cost = std::numeric_limits<double>::infinity();
  ceres::Problem problem;
  auto* residuals = new WhitenedResiduals(model, discrepancy, start);  // the problem's own
  problem.AddResidualBlock(residuals, nullptr, fit.unknowns.data());
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const PriorBounds bounds = model.own_parameters()[i].bounds();
    double& u = fit.unknowns[to_index(i)];
    u = std::clamp(u, bounds.lower, bounds.upper);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = start.most_iterations;
  options.function_tolerance = 1e-6;  // of a chi2 of thousands: far below what decides between hypotheses
  options.parameter_tolerance = 1e-4;
  options.max_num_consecutive_invalid_steps = 20;  // each twice, four, eight times ... shorter than the one before
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  FLAGS_minloglevel = google::GLOG_FATAL;  // a start that cannot be simulated is an answer, not a mistake
  if (!solve(options, problem, *residuals, model, start, fit)) return fit;
  if (is_held_up_by_range(model, discrepancy, start, fit)) {
    const Fit short_of_range = fit;
    set_ranges(model, problem, fit.unknowns.data());
    if (!solve(options, problem, *residuals, model, start, fit)) fit = short_of_range;
  }
  if (!model.simulate(fit.unknowns, start.threads, fit.simulated, nullptr)) {
    fit.cost = std::numeric_limits<double>::infinity();
  }
  return fit;
}

}  // namespace rollrig::diagnosis
