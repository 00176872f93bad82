#pragma once
/// Statistics of a least-squares fit of a law of rolling resistance.

#include <Eigen/Dense>

#include <optional>
#include <string>
#include <vector>

#include "estimation/rolling_law/rolling_points.h"
#include "include/rollrig/result.h"

namespace rollrig::estimation {

/// A point and what the fit makes of it.
struct FittedPoint {
  RollingPoint point;
  double fitted_N = 0.0;
  double leverage = 0.0;  // diagonal of the hat matrix
  double residual_N() const { return point.force_N - fitted_N; }
};

/// The F test of lack of fit: do the points leave the law by more than repeated points scatter?
/// Equation  F = [(S - S_p) / (d - d_p)] / (S_p / d_p); p = P(F(d - d_p, d_p) > F)
/// Symbols   S, d sum of squared residuals and degrees of freedom; S_p, d_p those of repeated points about their means
/// Validity  normal errors of one standard deviation
/// Source    textbook formula, as in Draper and Smith, Applied Regression Analysis; the book was not read
struct LackOfFit {
  double pure_error_sd_N = 0.0;
  int pure_error_freedom = 0;
  double F = 0.0;
  double p = 1.0;
};

/// What the residuals of a fit say.
struct RegressionStatistics {
  int freedom = 0;                       // points less coefficients; 0: no scatter is known, no intervals
  double residual_sd_N = 0.0;            // sqrt(S / freedom)
  double largest_residual = 0;           // over the measured force [1]
  int repeated_points = 0;               // points that share their condition with another
  std::optional<LackOfFit> lack_of_fit;  // where points are repeated and the law leaves freedom
};

/// Points count as repeats where speed, load and pressure agree within 0.5 %. Copies of a point are not part of the
/// pure error.
/// Assumed: 0.5 %, what a machine holds
RegressionStatistics calc_statistics(const std::vector<FittedPoint>& points, int coefficients);

/// Why there is no test of lack of fit.
std::string explain_no_lack_of_fit(int repeated_points);

/// A warning where a law misses a point by more than 3 % of its force, and by more than the points scatter. It names
/// the point that stands out from the others, which need not be the one that is missed most. The law does not fit where
/// an F test finds further terms of pressure, load and speed, or repeated points show a lack of fit (p < 0.002). Points
/// too few for the F test do not tell their scatter, and 3 % decides alone.
/// Assumed: 3 %, several times what repeated tests differ by; a point that stands out by chance in 1 of 200 sets
std::optional<std::string> doubt_largest_residual(const std::vector<FittedPoint>& points,
                                                  const RegressionStatistics& statistics,
                                                  const Eigen::MatrixXd& jacobian);

/// How far whole sets lie off a law. A set is all points of one load and pressure. They share one warm-up, one setting
/// of the pressure and one state of the air.
/// Equation  m_s = u_s^T e/|u_s|^2;  c = sum_s |Q^T u_s|^2/|u_s|^2,  d = k - c,  d_w = n - k - (p - c);
///           B = sum_s m_s^2 |u_s|^2,  s^2 = |e - sum_s m_s u_s|^2/d_w;
///           t^2 = max(0, (B - d s^2)/sum_s sum_r (u_s^T P u_r)^2/|u_s|^2),  P = 1 - Q Q^T;
///           probability that sets of independent points scatter as much: P(F(d, d_w) > B/(d s^2))
/// Symbols   e residuals [N]; u_s forces of the law at the points of set s, 0 at others [N]; Q orthonormal basis of the
///           Jacobian; n points, p coefficients, k sets; t standard deviation of a set's forces [1], s that of a point
///           within its set [N]
/// Validity  points of one standard deviation; where sets have different speeds, the F distribution is an approximation.
///           Points within 2 % of load and pressure belong to one set, and so do points that such points connect
/// Source    analysis of variance of a random effect by moments: E(B) = d s^2 + t^2 sum_s sum_r (...)
/// Checked   tests/estimation/rolling_law_test.cpp, rolling_law_coverage_test.cpp
struct SetScatter {
  std::vector<std::size_t> set_of_point;  // by point, from 0
  std::vector<double> set_errors;         // m_s [1]
  double freedom = 0.0;                   // d
  double freedom_within = 0.0;            // d_w
  double chance = 1.0;                    // that sets of independent points scatter as much
  double relative_sd = 0.0;               // t
  double point_sd_N = 0.0;                // s

  std::size_t set_count() const { return set_errors.size(); }
  /// Whole degrees of freedom of intervals that include it.
  int find_whole_freedom() const;
  /// Whether intervals must include it: the F test gives less than 0.25, and there are two degrees of freedom or more.
  /// Assumed: both; a higher level would take more sets without scatter for sets with scatter
  bool is_significant() const;
};

/// Absent if there are too few sets, or too few points within them, or if the points do not scatter.
std::optional<SetScatter> find_set_scatter(const std::vector<FittedPoint>& points, const Eigen::MatrixXd& jacobian);

/// Columns u_s of SetScatter: the law's forces at the points of each set.
Eigen::MatrixXd make_set_columns(const std::vector<FittedPoint>& points, const std::vector<std::size_t>& set_of_point);

/// (J^T J)^-1 by a QR decomposition of J with columns of unit length; `leverages` gets the diagonal of the hat matrix.
/// Throws RunFailure where the points do not decide the coefficients.
Eigen::MatrixXd invert_normal(const Eigen::MatrixXd& jacobian, std::vector<double>& leverages);

/// Half of a 95 % interval by Student's distribution over the standard deviation; infinite without freedom.
double calc_student_reach(int freedom);

/// A number with its standard deviation and 95 % interval.
ParameterEstimate make_student_estimate(const std::string& name, double value, double sd, int freedom,
                                        const std::string& unit);

}  // namespace rollrig::estimation
