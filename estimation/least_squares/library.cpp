#include "estimation/least_squares/library.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace rollrig::estimation {
namespace {

/// Ceres logs nothing below a fatal error to standard error: rollrig reports what matters of it. Once, since searches
/// run in several threads, and glog's level belongs to all of them.
void quiet_solver() {
  static std::once_flag is_quiet;
  std::call_once(is_quiet, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

/// The residuals as Ceres takes them: one block of unknowns.
class ResidualBlock : public ceres::CostFunction {
 public:
  ResidualBlock(const LeastSquaresProblem& problem, std::size_t unknowns) : problem_(problem) {
    set_num_residuals(static_cast<int>(problem.residuals));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns));
  }
  bool Evaluate(double const* const* unknowns, double* residuals, double** jacobians) const override {
    return problem_.evaluate(unknowns[0], residuals, jacobians != nullptr ? jacobians[0] : nullptr);
  }

 private:
  const LeastSquaresProblem& problem_;
};

class FollowIterations : public ceres::IterationCallback {
 public:
  explicit FollowIterations(const LeastSquaresProblem& problem) : problem_(problem) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& at) override {
    problem_.follow(at.iteration, at.cost, at.gradient_max_norm);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const LeastSquaresProblem& problem_;
};

ceres::Solver::Options make_options(const LeastSquaresOptions& asked) {
  ceres::Solver::Options options;
  options.linear_solver_type =
      asked.factorization == LeastSquaresOptions::Factorization::kQr ? ceres::DENSE_QR : ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = asked.most_iterations;
  options.max_num_consecutive_invalid_steps = asked.most_invalid_steps;
  options.function_tolerance = asked.function_tolerance;
  options.gradient_tolerance = asked.gradient_tolerance;
  options.parameter_tolerance = asked.parameter_tolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  return options;
}

void set_bounds(const LeastSquaresProblem& problem, double* unknowns, ceres::Problem& of_ceres) {
  for (std::size_t i = 0; i < problem.lower.size(); ++i) {
    const int at = static_cast<int>(i);
    if (std::isfinite(problem.lower[i])) of_ceres.SetParameterLowerBound(unknowns, at, problem.lower[i]);
    if (std::isfinite(problem.upper[i])) of_ceres.SetParameterUpperBound(unknowns, at, problem.upper[i]);
  }
}

/// Searches with the unknowns of these places held as they are.
LeastSquaresResult search(const LeastSquaresProblem& problem, const LeastSquaresOptions& asked,
                          const std::vector<int>& held, std::vector<double>& unknowns) {
  ceres::Problem of_ceres;
  of_ceres.AddResidualBlock(new ResidualBlock(problem, unknowns.size()), nullptr, unknowns.data());
  set_bounds(problem, unknowns.data(), of_ceres);
  if (!held.empty()) {
    of_ceres.SetManifold(unknowns.data(), new ceres::SubsetManifold(static_cast<int>(unknowns.size()), held));
  }
  ceres::Solver::Options options = make_options(asked);
  FollowIterations follow(problem);
  if (problem.follow) options.callbacks.push_back(&follow);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &of_ceres, &summary);
  return {summary.IsSolutionUsable(), summary.termination_type == ceres::CONVERGENCE, summary.final_cost,
          summary.message};
}

std::vector<int> find_on_bounds(const LeastSquaresProblem& problem, const std::vector<double>& unknowns) {
  std::vector<int> places;
  for (std::size_t i = 0; i < problem.lower.size(); ++i) {
    if (unknowns[i] <= problem.lower[i] || unknowns[i] >= problem.upper[i]) places.push_back(static_cast<int>(i));
  }
  return places;
}

/// Of the unknowns on bounds, those whose bound holds them: the sum would fall beyond it, not within.
std::vector<int> find_held(const LeastSquaresProblem& problem, const std::vector<double>& unknowns, double half_sum,
                           double tolerance) {
  const std::vector<int> on_bounds = find_on_bounds(problem, unknowns);
  if (on_bounds.empty()) return {};
  std::vector<double> residuals(problem.residuals);
  std::vector<double> jacobian(problem.residuals * unknowns.size());
  if (!problem.evaluate(unknowns.data(), residuals.data(), jacobian.data())) return on_bounds;
  std::vector<int> held;
  for (const int at : on_bounds) {
    const auto i = static_cast<std::size_t>(at);
    double gradient = 0.0;
    double curvature = 0.0;
    for (std::size_t row = 0; row < residuals.size(); ++row) {
      const double slope = jacobian[row * unknowns.size() + i];
      gradient += slope * residuals[row];
      curvature += slope * slope;
    }
    const bool falls_within = unknowns[i] <= problem.lower[i] ? gradient < 0.0 : gradient > 0.0;
    const bool is_worth_it = gradient * gradient > 2.0 * tolerance * half_sum * curvature;  // what it alone can gain
    if (!(falls_within && is_worth_it)) held.push_back(at);
  }
  return held;
}

class CeresLibrary : public LeastSquaresLibrary {
 public:
  LeastSquaresResult minimize(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
                              std::vector<double>& unknowns) const override {
    quiet_solver();
    std::vector<int> held;
    LeastSquaresResult result = search(problem, options, held, unknowns);
    // Ceres projects its steps onto the bounds, and so gets stuck before the others are at their best.
    for (std::size_t round = 0; result.has_converged && round < 4 * unknowns.size(); ++round) {
      std::vector<int> next = find_held(problem, unknowns, result.half_sum, options.function_tolerance);
      if (next == held || next.size() == unknowns.size()) break;
      held = std::move(next);
      result = search(problem, options, held, unknowns);
    }
    return result;
  }
};

}  // namespace
}  // namespace rollrig::estimation

extern "C" __attribute__((visibility("default"))) const rollrig::estimation::LeastSquaresLibrary*
rollrig_least_squares_library() {
  static const rollrig::estimation::CeresLibrary library;
  return &library;
}
