#pragma once
/// A straight line through the means of tires on two machines, and what a value on it is worth.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rollrig::estimation {

/// A standard deviation and how well it is known.
struct ScatterEstimate {
  double sd = 0.0;
  double degrees_of_freedom = 0.0;
  double low_95 = 0.0;  // of the standard deviation, by chi-square
  double high_95 = 0.0;
};

/// Standard deviation of one measurement, pooled over groups of repeats; groups of one add nothing.
///
/// Equation  s^2 = sum_ij (x_ij - mean_i)^2 / sum_i (n_i - 1); 95 % from s sqrt(f/chi2_f(0.975)) to
///           s sqrt(f/chi2_f(0.025))
/// Validity  one standard deviation for all groups, normal errors
/// Errors    std::invalid_argument: no group of two or more
/// Source    ISO 5725-2, repeatability; second-hand. For groups of equal size it is the mean square of their standard
///           deviations, which is sigma_m of EU 2020/740 Annex V Section 2.3. Second-hand
/// Checked   tests/estimation/alignment_test.cpp
ScatterEstimate pool_repeats(const std::vector<std::vector<double>>& groups);

/// The greatest step among 1, 0.5, 0.25, 0.2, 0.1, 0.05, ... of which all values are multiples; 0 where there is none,
/// and of no values. Of few values that are multiples of it by chance, it is too great.
double find_greatest_step(const std::vector<double>& values);
/// The step to which values are rounded: the greatest of which all are multiples, such as 0.05 of an instrument, or
/// that of the decimals where values of so many decimals would be multiples by chance.
/// Equation  (decimals/step)^n < 1e-3, of n different values. Assumed: 1e-3
/// Checked   tests/estimation/alignment_test.cpp
double find_value_step(const std::vector<double>& values);

/// Standard uncertainty of a value that is rounded to a step: step/sqrt(12).
/// Source    JCGM 100:2008 (GUM), F.2.2.1. Second-hand
double calc_rounding_sd(double step);

/// The scatter of one measurement, which is not smaller than its rounding.
/// Equation  s = max(s, step/sqrt(12)), and its interval likewise
/// Validity  rounding that is smaller than the scatter is within it, since it scatters as well
ScatterEstimate add_rounding(ScatterEstimate scatter, double step);

/// One tire of the line.
struct LinePoint {
  double x = 0.0;            // mean on the candidate machine
  double y = 0.0;            // of the reference machine
  double residual = 0.0;     // y less the line
  double leverage = 0.0;     // share of this point's y in the line's value there
  double studentized = 0.0;  // residual over its standard deviation without this point; NaN where none is known
  double p_value = 1.0;      // of a residual so large somewhere among the points, by Bonferroni

  /// Size of the residual, by the same measure for all points: its standard deviation is that of the scatter about the
  /// line.
  /// Equation  |residual|/sqrt(1 - leverage)
  double scaled_residual() const;
};

/// What the repeats say of the scatter of a point about the line.
struct RepeatScatter {
  double candidate_sd = 0.0;  // of a mean on the candidate machine
  double reference_sd = 0.0;  // of the value of the reference machine; 0 where it is not known
  double degrees_of_freedom = 0.0;
};

/// y = slope x + offset, by ordinary least squares.
///
/// Equation  slope = Sxy/Sxx; s_r^2 = sum residual^2/(p - 2); s_w^2 = sd_y^2 + slope^2 sd_x^2 of the repeats;
///           s = max(s_r, s_w); tau^2 = max(0, s_r^2 - s_w^2), what the tires differ by besides;
///           sd(slope) = s/sqrt(Sxx), sd(offset) = s sqrt(1/p + mean_x^2/Sxx);
///           studentized residual r_i/(s_(i) sqrt(1 - leverage_i)) with s_(i) the larger of the scatter of the other
///           points about their line and s_w: the scatter of few points may be small by chance;
///           attenuation = (p - 3) sd_x^2/Sxx, the share by which errors of x make the slope too small on average: to
///           first order Sxx is larger by (p - 1) sd_x^2, and 2 sd_x^2/Sxx comes of how both vary together
/// Validity  errors of x are small beside the range of x: attenuation far below 1. s is the larger
///           one, since p - 2 is three for five tires, and chance could make s_r too small
/// Source    textbook formulas, as in Draper and Smith, Applied Regression Analysis, which was not read; attenuation
///           derived here, to first order
/// Errors    std::invalid_argument: fewer than three points, or all of one x
/// Checked   tests/estimation/alignment_test.cpp
struct LineFit {
  double slope = 1.0;
  double offset = 0.0;
  double mean_x = 0.0;
  double Sxx = 0.0;
  std::vector<LinePoint> points;
  double residual_sd = 0.0;  // s_r
  double repeat_sd = 0.0;    // s_w
  double repeat_freedom = 0.0;
  double candidate_sd = 0.0;   // of a mean on the candidate machine, by its repeats
  double sd = 0.0;             // s
  double freedom = 0.0;        // of s
  double between_sd = 0.0;     // tau
  double lack_of_fit_p = 1.0;  // of so much scatter about the line, if the repeats said all; 1 without repeats
  double attenuation = 0.0;

  double slope_sd() const;
  double offset_sd() const;
  /// Factor of the 95 % interval of slope and offset.
  double coverage_factor() const;
  double value(double x) const { return slope * x + offset; }
};
LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y, const RepeatScatter& repeats);

/// A point that the line of the other points does not describe.
struct LineOutlier {
  std::size_t place = 0;     // among the points of the fit
  double by_others_y = 0.0;  // what the line of the other points gives at its x
  double p_value = 1.0;      // of so large a residual, or of so much lack of fit with the point
};
/// The point of the largest studentized residual, if its p is below 0.005 and its scaled residual is larger than
/// `least_size`. Needs four points: the other three show a scatter about their line.
/// Equation  y - e/(1 - h): the line of the other points at x, e residual and h leverage of the point
/// Assumed: 0.005, so that of 200 sets without a mistake one has such a point by chance
/// Checked   tests/estimation/alignment_test.cpp
std::optional<LineOutlier> find_line_outlier(const LineFit& fit, double least_size);

/// Probability that the points lie so near to the line, or nearer, if they scatter as the repeats say; 1 without
/// repeats. `repeat_sd` is that of a point about the line.
/// Equation  P(F <= s_r^2/repeat_sd^2), F of p - 2 and `repeat_freedom` degrees of freedom
double calc_too_near_p(const LineFit& fit, double repeat_sd, double repeat_freedom);

/// One contribution to the uncertainty of an aligned value.
struct AlignedContribution {
  std::string name;
  double sd = 0.0;  // in the unit of the result
  double degrees_of_freedom = 0.0;
};

/// An aligned value as GUM states it.
struct UncertainValue {
  double value = 0.0;
  double sd = 0.0;
  double degrees_of_freedom = 0.0;  // Welch and Satterthwaite
  double coverage_factor = 2.0;     // of 95 %
  std::vector<AlignedContribution> contributions;
};

/// Numbers of an alignment that a later value needs.
struct AlignmentLine {
  double A1 = 1.0, B1 = 0.0, A2 = 1.0, B2 = 0.0;
  double tires = 0.0;  // p
  double mean_x = 0.0, Sxx = 1.0;
  double line_sd = 0.0, line_freedom = 1.0;        // s
  double between_sd = 0.0, between_freedom = 1.0;  // tau
  double sigma_m = 0.0, sigma_m_freedom = 1.0;
  double candidate_sd = 0.0;  // u_x, of a mean on the candidate machine by sigma_m
  double rest_sd = 0.0;       // u_y, of s without it
  double rest_freedom = 1.0;  // of u_y; infinite where it is not estimated

  /// y = factor x + offset
  double calc_factor() const { return A1 * A2; }
  double calc_offset() const { return A1 * B2 + B1; }
};

/// The numbers of a line, with A1 = 1 and B1 = 0.
///
/// Equation  u_y^2 = s^2 - A2^2 u_x^2; its degrees of freedom are `reference_freedom` where s is that of the repeats,
///           else nu = (s^2 - a)^2 / (s^4/(p - 2) + a^2/nu_x), a = A2^2 u_x^2
/// Source    Satterthwaite's approximation, for a difference
AlignmentLine make_alignment_line(const LineFit& fit, const ScatterEstimate& sigma_m, double reference_freedom);

/// The aligned value of a tire that was measured so many times on the candidate machine.
///
/// Equation  y = A1 (A2 x + B2) + B1;  h = 1/p + (x - mean_x)^2/Sxx;
///           u^2 = A1^2 (s^2 h + tau^2 + A2^2 sigma_m^2/k) = A1^2 (A2^2 (u_x^2 h + sigma_m^2/k) + (u_y^2 h + tau^2));
///           effective degrees of freedom by Welch and Satterthwaite, of these two contributions: sigma_m is in both
///           terms of the first, the scatter about the line in both of the second
/// Validity  without the uncertainty of A1 and B1, which their laboratory has to state, and of the reference machine's
///           own correctness; 95 % by Student's t with the effective degrees of freedom
/// Source    JCGM 100:2008 (GUM), 5.1.2 and annex G.4. Second-hand
/// Checked   tests/estimation/alignment_test.cpp
UncertainValue align_value(const AlignmentLine& line, double x, int measurements);

}  // namespace rollrig::estimation
