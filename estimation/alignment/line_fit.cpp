#include "estimation/alignment/line_fit.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/statistics/linear_regression.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>

#include "estimation/alignment/alignment_rules.h"
#include "sim/core/limits.h"

namespace rollrig::estimation {
namespace {

using boost::math::complement;

double mean_of_values(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double calc_two_sided_t(double degrees_of_freedom) {
  return boost::math::quantile(complement(boost::math::students_t(degrees_of_freedom), 0.025));
}

/// Leverage, residual and what the others say of it.
void judge_points(LineFit& fit) {
  const double p = static_cast<double>(fit.points.size());
  const double rest = p - 3.0;
  const double squares = fit.residual_sd * fit.residual_sd * (p - 2.0);
  for (LinePoint& point : fit.points) {
    const double from_mean = point.x - fit.mean_x;
    point.leverage = 1.0 / p + from_mean * from_mean / fit.Sxx;
    point.studentized = std::numeric_limits<double>::quiet_NaN();
    const double left = squares - point.residual * point.residual / (1.0 - point.leverage);
    // Without a rest of scatter, its ratio is one of rounding errors.
    const bool has_rest = rest >= 1.0 && left > 1e-20 * (1.0 + squares);
    const double of_rest = has_rest ? left / rest : 0.0;
    const double of_repeats = fit.repeat_freedom > 0.0 ? fit.repeat_sd * fit.repeat_sd : 0.0;
    if (rest < 1.0 || std::max(of_rest, of_repeats) <= 0.0) continue;
    point.studentized = point.residual / std::sqrt(std::max(of_rest, of_repeats) * (1.0 - point.leverage));
    const double freedom = of_rest >= of_repeats ? rest : fit.repeat_freedom;
    const double one =
        2.0 * boost::math::cdf(complement(boost::math::students_t(freedom), std::abs(point.studentized)));
    point.p_value = std::min(1.0, p * one);
  }
}

void weigh_scatter(LineFit& fit, const RepeatScatter& repeats) {
  const double p = static_cast<double>(fit.points.size());
  double squares = 0.0;
  for (const LinePoint& point : fit.points) squares += point.residual * point.residual;
  fit.residual_sd = std::sqrt(squares / (p - 2.0));
  fit.repeat_sd = std::hypot(repeats.reference_sd, fit.slope * repeats.candidate_sd);
  fit.repeat_freedom = repeats.degrees_of_freedom;
  fit.candidate_sd = repeats.candidate_sd;
  const bool more_than_repeats = fit.residual_sd >= fit.repeat_sd;
  fit.sd = std::max(fit.residual_sd, fit.repeat_sd);
  fit.freedom = more_than_repeats ? p - 2.0 : repeats.degrees_of_freedom;
  const double excess = fit.residual_sd * fit.residual_sd - fit.repeat_sd * fit.repeat_sd;
  fit.between_sd = std::sqrt(std::max(0.0, excess));
  fit.attenuation = (p - 3.0) * repeats.candidate_sd * repeats.candidate_sd / fit.Sxx;
  if (fit.repeat_sd > 0.0 && fit.repeat_freedom > 0.0) {
    const double ratio = std::pow(fit.residual_sd / fit.repeat_sd, 2);
    fit.lack_of_fit_p = boost::math::cdf(complement(boost::math::fisher_f(p - 2.0, fit.repeat_freedom), ratio));
  }
}

/// The greatest step of 1/shares, with one decimal more each time, of which all values are multiples.
double find_step(const std::vector<double>& values, const std::vector<double>& shares) {
  if (values.empty()) return 0.0;
  constexpr int kMostDecimals = 6;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals) {
    for (const double share : shares) {
      const double steps = share * std::pow(10.0, decimals);
      const auto is_multiple = [steps](double value) {
        return std::abs(value * steps - std::round(value * steps)) < 1e-9 * std::max(1.0, std::abs(value * steps));
      };
      if (std::all_of(values.begin(), values.end(), is_multiple)) return 1.0 / steps;
    }
  }
  return 0.0;
}

/// Degrees of freedom of the scatter about the line without that of the candidate machine.
double find_rest_freedom(const LineFit& fit, double of_candidate, double candidate_freedom, double reference_freedom) {
  if (fit.residual_sd < fit.repeat_sd) return reference_freedom;
  const double all = fit.sd * fit.sd;
  const double spread =
      all * all / (static_cast<double>(fit.points.size()) - 2.0) + of_candidate * of_candidate / candidate_freedom;
  return spread > 0.0 ? std::max(1.0, std::pow(all - of_candidate, 2) / spread)
                      : std::numeric_limits<double>::infinity();
}

}  // namespace

std::size_t calc_measurements(const AlignmentRules& rules, double sigma_m_N_per_kN) {
  if (is_at_most(sigma_m_N_per_kN, rules.sigma_m_N_per_kN)) return rules.measurements;
  const double ratio = sigma_m_N_per_kN / rules.gamma_N_per_kN;
  return std::max(rules.measurements, static_cast<std::size_t>(round_up(1.0 + ratio * ratio)));
}

ScatterEstimate pool_repeats(const std::vector<std::vector<double>>& groups) {
  double squares = 0.0;
  ScatterEstimate pooled;
  for (const std::vector<double>& group : groups) {
    if (group.size() < 2) continue;
    const double mean = mean_of_values(group);
    for (const double value : group) squares += (value - mean) * (value - mean);
    pooled.degrees_of_freedom += static_cast<double>(group.size() - 1);
  }
  if (pooled.degrees_of_freedom < 1.0) throw std::invalid_argument("no repeats");
  pooled.sd = std::sqrt(squares / pooled.degrees_of_freedom);
  const boost::math::chi_squared distribution(pooled.degrees_of_freedom);
  pooled.low_95 =
      pooled.sd * std::sqrt(pooled.degrees_of_freedom / boost::math::quantile(complement(distribution, 0.025)));
  pooled.high_95 = pooled.sd * std::sqrt(pooled.degrees_of_freedom / boost::math::quantile(distribution, 0.025));
  return pooled;
}

double find_greatest_step(const std::vector<double>& values) { return find_step(values, {1.0, 2.0, 4.0, 5.0}); }

double find_value_step(const std::vector<double>& values) {
  constexpr double kLeastChance = 1e-3;
  const double of_decimals = find_step(values, {1.0}), greatest = find_greatest_step(values);
  if (!(of_decimals > 0.0)) return greatest;
  const std::size_t different = std::set<double>(values.begin(), values.end()).size();
  return std::pow(of_decimals / greatest, static_cast<double>(different)) < kLeastChance ? greatest : of_decimals;
}

double calc_rounding_sd(double step) { return step / std::sqrt(12.0); }

ScatterEstimate add_rounding(ScatterEstimate scatter, double step) {
  for (double* sd : {&scatter.sd, &scatter.low_95, &scatter.high_95}) *sd = std::max(*sd, calc_rounding_sd(step));
  return scatter;
}

double calc_too_near_p(const LineFit& fit, double repeat_sd, double repeat_freedom) {
  if (!(repeat_sd > 0.0) || !(repeat_freedom > 0.0)) return 1.0;
  const double between = static_cast<double>(fit.points.size()) - 2.0;
  return boost::math::cdf(boost::math::fisher_f(between, repeat_freedom), std::pow(fit.residual_sd / repeat_sd, 2));
}

double LinePoint::scaled_residual() const { return std::abs(residual) / std::sqrt(1.0 - leverage); }

double LineFit::slope_sd() const { return sd / std::sqrt(Sxx); }

double LineFit::offset_sd() const {
  return sd * std::sqrt(1.0 / static_cast<double>(points.size()) + mean_x * mean_x / Sxx);
}

double LineFit::coverage_factor() const { return calc_two_sided_t(freedom); }

LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y, const RepeatScatter& repeats) {
  if (x.size() < 3 || x.size() != y.size()) throw std::invalid_argument("a line needs three points");
  LineFit fit;
  fit.mean_x = mean_of_values(x);
  for (const double value : x) fit.Sxx += (value - fit.mean_x) * (value - fit.mean_x);
  if (!(fit.Sxx > 0.0)) throw std::invalid_argument("all points have one x");
  std::tie(fit.offset, fit.slope) = boost::math::statistics::simple_ordinary_least_squares(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    fit.points.push_back({x[i], y[i], y[i] - fit.value(x[i]), 0.0, 0.0, 1.0});
  }
  weigh_scatter(fit, repeats);
  judge_points(fit);
  return fit;
}

std::optional<LineOutlier> find_line_outlier(const LineFit& fit, double least_size) {
  constexpr double kUnlikely = 0.005;
  const auto weigh = [](const LinePoint& point) {
    return std::isfinite(point.studentized) ? std::abs(point.studentized) : 0.0;
  };
  const auto worst = std::max_element(fit.points.begin(), fit.points.end(),
                                      [&](const LinePoint& a, const LinePoint& b) { return weigh(a) < weigh(b); });
  if (worst == fit.points.end() || weigh(*worst) <= 0.0 || worst->p_value >= kUnlikely) return std::nullopt;
  if (worst->scaled_residual() <= least_size) return std::nullopt;
  const double by_others_y = worst->y - worst->residual / (1.0 - worst->leverage);
  return LineOutlier{static_cast<std::size_t>(worst - fit.points.begin()), by_others_y, worst->p_value};
}

AlignmentLine make_alignment_line(const LineFit& fit, const ScatterEstimate& sigma_m, double reference_freedom) {
  AlignmentLine line;
  line.A2 = fit.slope;
  line.B2 = fit.offset;
  line.tires = static_cast<double>(fit.points.size());
  line.mean_x = fit.mean_x;
  line.Sxx = fit.Sxx;
  line.line_sd = fit.sd;
  line.line_freedom = fit.freedom;
  line.between_sd = fit.between_sd;
  line.between_freedom = line.tires - 2.0;
  line.sigma_m = sigma_m.sd;
  line.sigma_m_freedom = sigma_m.degrees_of_freedom;
  line.candidate_sd = fit.candidate_sd;
  const double of_candidate = std::pow(fit.slope * fit.candidate_sd, 2);
  line.rest_sd = std::sqrt(std::max(0.0, fit.sd * fit.sd - of_candidate));
  line.rest_freedom = find_rest_freedom(fit, of_candidate, sigma_m.degrees_of_freedom, reference_freedom);
  return line;
}

UncertainValue align_value(const AlignmentLine& line, double x, int measurements) {
  const double from_mean = x - line.mean_x;
  const double scale = std::abs(line.A1);
  const double leverage = 1.0 / line.tires + from_mean * from_mean / line.Sxx;
  const double of_line = line.line_sd * std::sqrt(leverage);
  const double of_repeats = std::abs(line.A2) * line.sigma_m / std::sqrt(static_cast<double>(measurements));
  UncertainValue aligned;
  aligned.value = line.A1 * (line.A2 * x + line.B2) + line.B1;
  aligned.contributions = {{"A2 and B2", scale * of_line, line.line_freedom},
                           {"tire-to-tire scatter about the line", scale * line.between_sd, line.between_freedom},
                           {"sigma_m of the measured value", scale * of_repeats, line.sigma_m_freedom}};
  // What rests on one estimate errs together: sigma_m in line and value, the rest in line and tires.
  const double of_candidate = std::pow(line.A2 * line.candidate_sd, 2) * leverage + of_repeats * of_repeats;
  const double of_rest = line.rest_sd * line.rest_sd * leverage + line.between_sd * line.between_sd;
  const double variance = scale * scale * (of_candidate + of_rest);
  const double by_freedom = std::pow(scale, 4) * (of_candidate * of_candidate / line.sigma_m_freedom +
                                                  of_rest * of_rest / line.rest_freedom);
  aligned.sd = std::sqrt(variance);
  aligned.degrees_of_freedom = by_freedom > 0.0 ? variance * variance / by_freedom : 1.0;
  aligned.coverage_factor = calc_two_sided_t(aligned.degrees_of_freedom);
  return aligned;
}

}  // namespace rollrig::estimation
