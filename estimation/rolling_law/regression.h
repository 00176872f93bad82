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

/// A doubt where whole sets of one load and pressure lie off the law by more than the points within sets scatter: the
/// intervals are too narrow then. If a set is far off, its load or its pressure may be wrong.
/// Equation  F = [sum_s n_s m_s^2/(k - 3)] / [sum_s sum_i (r_si - m_s)^2/(n - k)], F distribution with k - 3 and n - k
///           degrees of freedom
/// Symbols   r_si residual over force of point i in set s, m_s their mean, n_s points of the set; k sets, n points
/// Validity  a law with level and two exponents over the sets; sets are told apart by 2 % of load or pressure
/// Assumed: doubted if p < 0.001; loads and pressures if the largest |m_s| is above 3 %, too
std::optional<std::string> doubt_sets(const std::vector<FittedPoint>& points);

/// (J^T J)^-1 by a QR decomposition of J with columns of unit length; `leverages` gets the diagonal of the hat matrix.
/// Throws RunFailure where the points do not decide the coefficients.
Eigen::MatrixXd invert_normal(const Eigen::MatrixXd& jacobian, std::vector<double>& leverages);

/// Half of a 95 % interval by Student's distribution over the standard deviation; infinite without freedom.
double calc_student_reach(int freedom);

/// A number with its standard deviation and 95 % interval.
ParameterEstimate make_student_estimate(const std::string& name, double value, double sd, int freedom,
                                        const std::string& unit);

}  // namespace rollrig::estimation
