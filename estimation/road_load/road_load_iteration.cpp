#include "estimation/road_load/road_load_iteration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Least components: a speed resolution far below any sensor's, so that data without noise keep weights.
VectorXd make_floors() {
  constexpr double kLeastSpeedSd_m_s = 1e-4;  // Assumed
  VectorXd floors = VectorXd::Zero(kComponents);
  floors(kPassing) = kLeastSpeedSd_m_s * kLeastSpeedSd_m_s;
  return floors;
}

/// Whether no component would move by more than a tenth of itself; a billionth of the largest one counts as none.
bool stays(const VectorXd& components, const VectorXd& wanted) {
  constexpr double kMostChange = 0.1, kNone = 1e-9;
  const double none = kNone * components.maxCoeff();
  for (Index i = 0; i < components.size(); ++i) {
    const double larger = std::max(components(i), wanted(i));
    if (larger > none && std::abs(wanted(i) - components(i)) > kMostChange * larger) return false;
  }
  return true;
}

/// Moves towards `wanted`, less far where the force would not stay positive.
double step_to(const CoastdownProblem& problem, const VectorXd& wanted, VectorXd& coefficients) {
  double share = 1.0;
  while (share > 1e-3 && !all_possible(problem, coefficients + share * (wanted - coefficients))) share *= 0.5;
  if (share <= 1e-3)
    throw RunFailure(
        "the fitted road load is not positive at every speed of the data: was the vehicle braked or driven in part of "
        "it? Leave that part out (--speed-from, --speed-to)");
  coefficients += share * (wanted - coefficients);
  return share;
}

VectorXd bound(const std::array<double, 3>& values) { return Eigen::Map<const Eigen::Vector3d>(values.data()); }

}  // namespace

IteratedFit iterate_road_load(const CoastdownProblem& problem, const std::optional<RoadLoadBounds>& bounds,
                              const IterationStart& start, Components kind) {
  constexpr int kMostIterations = 200;
  constexpr int kUndampedIterations = 10;
  constexpr int kHoldAfter = 50;             // iterations, the components
  constexpr double kCoefficientStep = 1e-4;  // of a standard deviation
  constexpr double kHeldStep = 1e-3;         // the same where components are held, and steps are small
  constexpr double kComponentStep = 1e-3;    // of a component
  const VectorXd floors = make_floors();
  VectorXd coefficients = start.coefficients;
  VectorXd components = start.components;
  for (int iterations = 1; iterations <= kMostIterations; ++iterations) {
    const std::vector<LinearBlock> blocks = linearize_all(problem, coefficients, components);
    LinearEstimate estimate = kind == Components::kHeld ? solve_weighted(blocks, components)
                                                        : step_variance_components(blocks, components, floors);
    const LinearEstimate unbounded = estimate;
    if (bounds.has_value()) apply_bounds(estimate, bound(bounds->lower), bound(bounds->upper));
    // without scatter of passing times the covariance has no inverse: a first guess must not take it all away
    estimate.components(kPassing) = std::max(estimate.components(kPassing), 0.1 * components(kPassing));
    const VectorXd before = coefficients;
    // steps that come back on themselves are halved, as those of components
    const double step = iterations <= kUndampedIterations ? 1.0 : 0.5;
    const VectorXd wanted = before + step * (estimate.coefficients - before);
    const double share = step_to(problem, wanted, coefficients);
    const VectorXd sd = estimate.covariance.diagonal().cwiseSqrt();
    bool settled = share == 1.0;
    const bool held = iterations > kHoldAfter;
    const double most = held ? kHeldStep : kCoefficientStep;
    for (Index i = 0; i < coefficients.size(); ++i) {
      settled = settled &&
                std::abs(coefficients(i) - before(i)) <= most * sd(i) + 1e-9 * std::abs(coefficients(i));
    }
    const double scale = (components - estimate.components).cwiseAbs().maxCoeff();
    for (Index i = 0; i < components.size() && !held; ++i) {
      const double change = std::abs(estimate.components(i) - components(i));
      settled = settled && (change <= kComponentStep * std::max(components(i), estimate.components(i)) ||
                            change <= 1e-12 * scale || estimate.components(i) == floors(i));
    }
    // a component that comes and goes across its floor would go on for ever: halve its steps, then hold it
    if (iterations <= kUndampedIterations) {
      components = estimate.components;
    } else if (!held) {
      components = 0.5 * (components + estimate.components);
    }
    if (settled) {
      const bool components_settled = !held || stays(components, estimate.components);
      return {estimate, unbounded, coefficients, components, iterations, components_settled};
    }
  }
  throw RunFailure(fmt::format("the fit of the road load does not converge within {} iterations", kMostIterations));
}

}  // namespace rollrig::estimation
