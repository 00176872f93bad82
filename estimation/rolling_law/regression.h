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

/// How far whole sets lie off a law. A set is the points of one load and pressure: its tire is warmed up, its pressure
/// set and its air taken once for all of them.
/// Equation  m_s = u_s^T e/|u_s|^2;  B = sum_s m_s^2 |u_s|^2,  s^2 = |e - sum_s m_s u_s|^2/(n - k - q);
///           t^2 = max(0, (B - (k - p) s^2)/sum_s sum_r (u_s^T P u_r)^2/|u_s|^2);
///           probability that sets of independent points scatter as much: P(F(k - p, n - k - q) > B/((k - p) s^2))
/// Symbols   e residuals [N]; u_s forces of the law at the points of set s, 0 at others [N]; P = 1 - J (J^T J)^-1 J^T,
///           J Jacobian; n points, k sets; p terms of the law that differ from set to set, q its others; t standard
///           deviation of a set's forces [1], s that of a point within its set [N]
/// Validity  points of one standard deviation; sets are told apart by 2 % of load or pressure
/// Source    analysis of variance of a random effect by moments: E(B) = (k - p) s^2 + t^2 sum sum (...)
/// Checked   tests/estimation/rolling_law_test.cpp, rolling_law_coverage_test.cpp
struct SetScatter {
  std::vector<std::size_t> set_of_point;  // by point, from 0
  std::vector<double> set_errors;         // m_s [1]
  int freedom = 0;                        // k - p
  int freedom_within = 0;                 // n - k - q
  double chance = 1.0;                    // that sets of independent points scatter as much
  double relative_sd = 0.0;               // t
  double point_sd_N = 0.0;                // s

  std::size_t set_count() const { return set_errors.size(); }
  /// Whether intervals have to hold it: unless the points speak for none, and two degrees of freedom at least tell it.
  /// Assumed: a chance below 0.25, the usual level from which a variance is not pooled
  bool counts() const;
};

/// Of a law that has `terms_of_sets` terms that differ from set to set, as level and exponents do. Absent where the
/// sets or the points within them are too few, or the points do not scatter.
std::optional<SetScatter> find_set_scatter(const std::vector<FittedPoint>& points, const Eigen::MatrixXd& jacobian,
                                           int terms_of_sets);

/// A doubt where whole sets lie off the law by more than the points within sets scatter. If a set is far off, its load
/// or its pressure may be wrong.
/// Assumed: doubted if the chance is below 0.001; loads and pressures if the largest |m_s| is above 3 %, too
std::optional<std::string> doubt_sets(const std::vector<FittedPoint>& points, const SetScatter& scatter);

/// (J^T J)^-1 by a QR decomposition of J with columns of unit length; `leverages` gets the diagonal of the hat matrix.
/// Throws RunFailure where the points do not decide the coefficients.
Eigen::MatrixXd invert_normal(const Eigen::MatrixXd& jacobian, std::vector<double>& leverages);

/// Half of a 95 % interval by Student's distribution over the standard deviation; infinite without freedom.
double calc_student_reach(int freedom);

/// A number with its standard deviation and 95 % interval.
ParameterEstimate make_student_estimate(const std::string& name, double value, double sd, int freedom,
                                        const std::string& unit);

}  // namespace rollrig::estimation
