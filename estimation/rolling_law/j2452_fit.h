#pragma once
/// The law of SAE J2452 from points (`rollrig fit j2452`).

#include "estimation/rolling_law/j2452_law.h"
#include "estimation/rolling_law/regression.h"

namespace rollrig::estimation {

/// A force at one condition, or a mean over a drive, with its standard deviation.
struct ForceEstimate {
  double value_N = 0.0;
  double sd_N = 0.0;
};

struct J2452Fit {
  J2452Law law;
  std::vector<ParameterEstimate> coefficients;  // alpha, beta, a, b, c
  std::vector<FittedPoint> points;
  RegressionStatistics statistics;
  std::optional<SetScatter> set_scatter;  // if sets may scatter, and are enough to tell
  std::vector<std::string> warnings;

  /// Whether standard deviations and intervals include the scatter from set to set.
  bool includes_set_scatter() const { return set_scatter.has_value() && set_scatter->is_significant(); }
  /// Degrees of freedom of the intervals: those of the sets if they include their scatter, else those of the points.
  int find_freedom() const { return includes_set_scatter() ? set_scatter->find_whole_freedom() : statistics.freedom; }
  /// At one condition.
  ForceEstimate estimate_force(const ReferenceCondition& at) const;
  /// The mean over a drive.
  ForceEstimate estimate_mean(double pressure_Pa, double load_N, const SpeedMoments& moments) const;

  // The fit itself, in the scaling in which it is well conditioned: F = F0 (P/P0)^alpha (Z/Z0)^beta (q0 + q1 x + q2
  // x^2), x = (v - v0)/h; covariance of alpha, beta, q0, q1, q2.
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double pressure_0_Pa = 1.0;
  double load_0_N = 1.0;
  double force_0_N = 1.0;
  double speed_0_m_s = 0.0;
  double half_range_m_s = 1.0;

 private:
  ForceEstimate estimate(double pressure_Pa, double load_N, double mean_x, double mean_x2) const;
};

/// What is random in the points of a test: each of them, or whole sets of one load and pressure as well.
enum class RandomPart { kPoints, kPointsAndSets };

/// Nonlinear least squares of forces in N, all points with the same weight.
///
/// Standard deviations follow from the residuals, intervals of 95 % from Student's distribution. If sets of one load
/// and pressure may scatter, and do (SetScatter::is_significant()), the covariance includes that, and the intervals
/// have the degrees of freedom of the sets.
/// Equation  (J^T J)^-1 J^T V J (J^T J)^-1;  V = s^2 1, or in a set s^2 1 + t^2 F F^T
/// Symbols   J Jacobian, F forces of the points of a set [N], s and t of SetScatter
/// The intervals of a, b and c hold the uncertainty of the exponents: a is the force at 1 kPa, 1 N and standstill, far
/// from every point, and moves with them. Each is a product of two numbers that are nearly normal, and its interval
/// holds the values that it takes over their 95 % ellipse (likelihood ratio).
/// Errors    InputError: fewer than six points, fewer than two pressures or loads, fewer than three speeds; RunFailure:
///           no convergence, or pressure and load that vary together
/// Checked   tests/estimation/rolling_law_test.cpp, rolling_law_coverage_test.cpp
J2452Fit fit_j2452(const std::vector<RollingPoint>& points, RandomPart random = RandomPart::kPoints);

/// A doubt where the points show a force that depends on speed alone, as a parasitic loss that was not subtracted does.
/// An exponent of load that no tire has is doubted by doubt_trends().
///
/// Equation  F = P^alpha Z^beta (a + b v + c v^2) + e + f v^2;  t = F_e/u(F_e), F_e = e + f v^2 at the middle speed;
///           doubted if P(t(n - 7) > t) < 0.0005; with the degrees of freedom of the sets if these may scatter, and do
///           beside e + f v^2 as well (chance of SetScatter below 0.01)
/// Validity  three loads or more. A tire whose law bends over load, since a higher load warms it more, hides the loss:
///           such points show F_e below zero where nothing is wrong
/// Assumed: the level of significance; F_e above a tenth of the smallest force; beta of 0.8 to 1.4 beside it
/// Checked   tests/estimation/rolling_law_test.cpp
std::optional<std::string> doubt_parasitic_loss(const J2452Fit& fit);

/// A doubt where whole sets lie off the law by more than the points within sets scatter. If a set is far off, its load
/// or its pressure may be wrong.
/// Assumed: doubted if the chance is below 0.001; loads and pressures if the largest |m_s| is above 3 %, too
std::optional<std::string> doubt_sets(const J2452Fit& fit);

}  // namespace rollrig::estimation
