#include "diagnosis/comparison/refit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
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
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return fit;
  if (residuals->last().unknowns.size() > 0 && residuals->last().unknowns == fit.unknowns) {
    fit.residuals = residuals->last().residuals;
    fit.jacobian = residuals->last().jacobian;
  } else if (!model.evaluate(fit.unknowns, start.threads, fit.residuals, &fit.jacobian)) {
    return fit;
  }
  if (!model.simulate(fit.unknowns, start.threads, fit.simulated, nullptr)) return fit;
  fit.cost = summary.final_cost;
  return fit;
}

}  // namespace rollrig::diagnosis
