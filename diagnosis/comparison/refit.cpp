#include "diagnosis/comparison/refit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/comparison/bounded_step.h"
#include "estimation/least_squares/least_squares.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kFunctionTolerance = 1e-6;  // of a chi2 of thousands: far below what decides between hypotheses

/// Residuals whitened by the sensors, and their derivatives.
struct Derived {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd residuals;
  RowMatrix jacobian;

  bool is_at(const Eigen::VectorXd& u) const { return unknowns.size() == u.size() && unknowns == u; }
};

Derived find_known(const RefitStart& start) {
  if (start.known == nullptr || !std::isfinite(start.known->cost)) return {};  // a fit that failed has no derivatives
  return {start.known->unknowns, start.known->residuals, start.known->jacobian};
}

/// Whitened residuals, then the unknowns themselves, whose priors are standard normal.
class WhitenedResiduals {
 public:
  WhitenedResiduals(const Model& model, const Discrepancy& discrepancy, const RefitStart& start)
      : model_(model),
        discrepancy_(discrepancy),
        amplitudes_(start.amplitudes),
        threads_(start.threads),
        last_(find_known(start)) {}

  std::size_t count() const { return model_.residual_count() + model_.unknown_count(); }

  /// False where the model cannot be simulated.
  bool evaluate(const double* at, double* out, double* derivatives) {
    const Eigen::Index unknowns = to_index(model_.unknown_count());
    const Eigen::Index rows = to_index(model_.residual_count());
    const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(at, unknowns);
    const bool derive = derivatives != nullptr;
    Eigen::VectorXd residuals;
    RowMatrix jacobian;
    if (derive && last_.is_at(u)) {
      residuals = last_.residuals;
      jacobian = last_.jacobian;
    } else if (!model_.evaluate(u, threads_, residuals, derive ? &jacobian : nullptr)) {
      return false;
    }
    const Eigen::VectorXd whitened = residuals;
    discrepancy_.whiten(amplitudes_, residuals);
    Eigen::Map<Eigen::VectorXd>(out, rows) = residuals;
    Eigen::Map<Eigen::VectorXd>(out + rows, unknowns) = u;
    if (derive) {
      last_ = {u, whitened, jacobian};
      discrepancy_.whiten(amplitudes_, jacobian);
      Eigen::Map<RowMatrix> all(derivatives, rows + unknowns, unknowns);
      all.topRows(rows) = jacobian;
      all.bottomRows(unknowns).setIdentity();
    }
    return true;
  }

  /// Where they were last derived.
  const Derived& last() const { return last_; }

 private:
  const Model& model_;
  const Discrepancy& discrepancy_;
  const Amplitudes& amplitudes_;
  int threads_;
  Derived last_;
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

/// The unknowns' distances to the ends of their ranges; only own parameters have ranges.
struct Room {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

Room find_room(const Model& model, const Eigen::VectorXd& unknowns) {
  const double infinity = std::numeric_limits<double>::infinity();
  Room room{Eigen::VectorXd::Constant(unknowns.size(), -infinity),
            Eigen::VectorXd::Constant(unknowns.size(), infinity)};
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const PriorBounds bounds = model.own_parameters()[i].bounds();
    room.lower[to_index(i)] = bounds.lower - unknowns[to_index(i)];
    room.upper[to_index(i)] = bounds.upper - unknowns[to_index(i)];
  }
  return room;
}

/// Puts own parameters that rounding has moved out of their ranges back.
void keep_in_ranges(const Model& model, Eigen::VectorXd& unknowns) {
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const PriorBounds bounds = model.own_parameters()[i].bounds();
    unknowns[to_index(i)] = std::clamp(unknowns[to_index(i)], bounds.lower, bounds.upper);
  }
}

/// Levenberg and Marquardt within the ranges, from a fit: each step is the best one within them of the linearized
/// residuals. A step costs one simulation and, where it is taken, one with derivatives; ceres' line search along the
/// ranges costs three of these.
class FitWithinRanges {
 public:
  FitWithinRanges(const Model& model, const Discrepancy& discrepancy, const RefitStart& start, Fit& fit)
      : model_(model), discrepancy_(discrepancy), start_(start), fit_(fit) {}

  /// Moves the fit to its best, and keeps it where nothing better is found.
  void solve() {
    linearize();
    double damping = 1e-4;  // as ceres begins
    double growth = 2.0;
    for (int i = 0; i < start_.most_iterations; ++i) {
      Eigen::MatrixXd damped = curvature_;
      damped.diagonal() *= 1.0 + damping;
      const Room room = find_room(model_, fit_.unknowns);
      const Eigen::VectorXd step = solve_within(damped, -gradient_, room.lower, room.upper);
      const double promised = -gradient_.dot(step) - 0.5 * step.dot(curvature_ * step);
      if (!(promised > kFunctionTolerance * cost_)) return;
      Eigen::VectorXd unknowns = fit_.unknowns + step;
      keep_in_ranges(model_, unknowns);
      const double gained = cost_ - calc_cost(unknowns);
      if (!(gained > 0.0)) {
        damping *= growth;
        growth *= 2.0;
        continue;
      }
      const bool is_last = gained < kFunctionTolerance * cost_;
      if (!move_to(unknowns)) return;
      if (is_last) return;
      damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gained / promised - 1.0, 3));
      growth = 2.0;
    }
  }

 private:
  /// Infinite where it cannot be simulated.
  double calc_cost(const Eigen::VectorXd& unknowns) const {
    Eigen::VectorXd residuals;
    if (!model_.evaluate(unknowns, start_.threads, residuals, nullptr)) return std::numeric_limits<double>::infinity();
    discrepancy_.whiten(start_.amplitudes, residuals);
    return 0.5 * (residuals.squaredNorm() + unknowns.squaredNorm());
  }

  bool move_to(const Eigen::VectorXd& unknowns) {
    Eigen::VectorXd residuals;
    RowMatrix jacobian;
    if (!model_.evaluate(unknowns, start_.threads, residuals, &jacobian)) return false;
    fit_.unknowns = unknowns;
    fit_.residuals = std::move(residuals);
    fit_.jacobian = std::move(jacobian);
    linearize();
    return true;
  }

  void linearize() {
    RowMatrix jacobian = fit_.jacobian;
    Eigen::VectorXd residuals = fit_.residuals;
    discrepancy_.whiten(start_.amplitudes, jacobian);
    discrepancy_.whiten(start_.amplitudes, residuals);
    const Eigen::Index n = jacobian.cols();
    curvature_ = jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(n, n);
    gradient_ = jacobian.transpose() * residuals + fit_.unknowns;
    cost_ = fit_.cost = 0.5 * (residuals.squaredNorm() + fit_.unknowns.squaredNorm());
  }

  const Model& model_;
  const Discrepancy& discrepancy_;
  const RefitStart& start_;
  Fit& fit_;
  Eigen::MatrixXd curvature_;
  Eigen::VectorXd gradient_;
  double cost_ = 0.0;
};

/// Minimizes, and derives the residuals where it stops. False where that is no solution; then the cost is infinite.
bool solve(WhitenedResiduals& residuals, const Model& model, const RefitStart& start, Fit& fit) {
  fit.cost = std::numeric_limits<double>::infinity();
  estimation::LeastSquaresProblem problem;
  problem.residuals = residuals.count();
  problem.evaluate = [&residuals](const double* unknowns, double* out, double* derivatives) {
    return residuals.evaluate(unknowns, out, derivatives);
  };
  estimation::LeastSquaresOptions options;
  options.factorization = estimation::LeastSquaresOptions::Factorization::kNormalCholesky;
  options.most_iterations = start.most_iterations;
  options.most_invalid_steps = 20;  // each twice, four, eight times ... shorter than the one before
  options.function_tolerance = kFunctionTolerance;
  options.parameter_tolerance = 1e-4;
  std::vector<double> unknowns(fit.unknowns.begin(), fit.unknowns.end());
  const estimation::LeastSquaresResult result = estimation::minimize_squares(problem, options, unknowns);
  fit.unknowns = Eigen::Map<const Eigen::VectorXd>(unknowns.data(), fit.unknowns.size());
  if (!result.is_usable) return false;
  if (residuals.last().is_at(fit.unknowns)) {
    fit.residuals = residuals.last().residuals;
    fit.jacobian = residuals.last().jacobian;
  } else if (!model.evaluate(fit.unknowns, start.threads, fit.residuals, &fit.jacobian)) {
    return false;
  }
  fit.cost = result.half_sum;
  return true;
}

}  // namespace

Fit refit(const Model& model, const Discrepancy& discrepancy, const RefitStart& start) {
  Fit fit;
  fit.hypothesis = model.hypothesis();
  fit.unknowns = start.unknowns;
  fit.cost = std::numeric_limits<double>::infinity();
  keep_in_ranges(model, fit.unknowns);
  WhitenedResiduals residuals(model, discrepancy, start);
  if (!solve(residuals, model, start, fit)) return fit;
  if (is_held_up_by_range(model, discrepancy, start, fit)) FitWithinRanges(model, discrepancy, start, fit).solve();
  if (!model.simulate(fit.unknowns, start.threads, fit.simulated, nullptr)) {
    fit.cost = std::numeric_limits<double>::infinity();
  }
  return fit;
}

}  // namespace rollrig::diagnosis
