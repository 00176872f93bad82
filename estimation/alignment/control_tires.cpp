#include "estimation/alignment/control_tires.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace rollrig::estimation {
namespace {

constexpr double kDay = 86400.0;
constexpr double kYear_s = 365.25 * kDay;
constexpr double kLeastShiftFreedom = 2.0;    // that of two measurements on each side
constexpr double kRounding_N_per_kN = 1e-9;  // of a mean of equal values
constexpr double kMeanRangeOfTwo = 1.128;  // d2: expected range of two normal values over their standard deviation

/// A value within half a step of the center is on no side: without its rounding it may be on either.
std::size_t find_longest_run(const ControlChart& chart, double step) {
  const double within = 0.5 * step + kRounding_N_per_kN;
  std::size_t longest = 0, run = 0;
  int side_before = 0;
  for (const double value : chart.rrc_N_per_kN) {
    const double over = value - chart.center_N_per_kN;
    const int side = over > within ? 1 : over < -within ? -1 : 0;
    run = side != 0 && side == side_before ? run + 1 : (side != 0 ? 1 : 0);
    side_before = side;
    longest = std::max(longest, run);
  }
  return longest;
}

/// Least squares of the values over x, with one slope within tires of their own levels.
struct CommonSlope {
  double slope = 0.0;
  double freedom = 0.0;
  double sd = 0.0;  // of the slope
  double p_value = 1.0;
};

/// `x_of`: of a time [s]. None where x is one within each tire.
template <typename XOfTime>
std::optional<CommonSlope> fit_common_slope(const std::vector<ControlChart>& charts, double step, const XOfTime& x_of) {
  double Sxx = 0.0, Sxy = 0.0, Syy = 0.0;
  CommonSlope common{0.0, -1.0};
  for (const ControlChart& chart : charts) {
    const double count = static_cast<double>(chart.time_s.size());
    double mean_x = 0.0;
    for (const double time_s : chart.time_s) mean_x += x_of(time_s) / count;
    for (std::size_t i = 0; i < chart.time_s.size(); ++i) {
      const double x = x_of(chart.time_s[i]) - mean_x, y = chart.rrc_N_per_kN[i] - chart.center_N_per_kN;
      Sxx += x * x;
      Sxy += x * y;
      Syy += y * y;
    }
    common.freedom += count - 1.0;
  }
  if (common.freedom < 1.0 || !(Sxx > 0.0)) return std::nullopt;
  common.slope = Sxy / Sxx;
  const double about = std::sqrt(std::max(0.0, Syy - Sxy * Sxy / Sxx) / common.freedom);
  common.sd = std::max(about, calc_rounding_sd(step)) / std::sqrt(Sxx);
  if (!(common.sd > 0.0)) return common;
  const boost::math::students_t distribution(common.freedom);
  common.p_value =
      2.0 * boost::math::cdf(boost::math::complement(distribution, std::abs(common.slope) / common.sd));
  return common;
}

double calc_years(double time_s) { return time_s / kYear_s; }

/// The least number of measurements on one side of a day, of the tires that have some on both.
std::size_t count_on_lesser_side(const std::vector<ControlChart>& charts, double from_s) {
  std::size_t before = 0, after = 0;
  for (const ControlChart& chart : charts) {
    const auto first_after = std::lower_bound(chart.time_s.begin(), chart.time_s.end(), from_s);
    if (first_after == chart.time_s.begin() || first_after == chart.time_s.end()) continue;
    before += static_cast<std::size_t>(first_after - chart.time_s.begin());
    after += static_cast<std::size_t>(chart.time_s.end() - first_after);
  }
  return std::min(before, after);
}

/// The significant step of the mean that all tires have in common, where it is likelier than a drift.
std::optional<ControlShift> find_shift(const std::vector<ControlChart>& charts, double step) {
  constexpr std::size_t kLeastOnASide = 2;
  std::set<double> times_s;
  for (const ControlChart& chart : charts) times_s.insert(chart.time_s.begin(), chart.time_s.end());
  ControlShift shift;
  double places = 0.0;
  for (const double from_s : times_s) {
    if (count_on_lesser_side(charts, from_s) < kLeastOnASide) continue;
    const auto found = fit_common_slope(charts, step, [from_s](double time_s) { return time_s < from_s ? 0.0 : 1.0; });
    if (!found.has_value() || found->freedom < kLeastShiftFreedom) continue;
    places += 1.0;
    if (found->p_value < shift.p_value) shift = {from_s, found->slope, found->p_value};
  }
  shift.p_value = std::min(1.0, shift.p_value * places);
  if (places < 1.0 || !(shift.p_value < kShiftLevel)) return std::nullopt;
  const auto drift = fit_common_slope(charts, step, calc_years);
  return drift.has_value() && drift->p_value < shift.p_value ? std::nullopt : std::optional(shift);
}

ControlChart make_chart(const ControlTire& tire, double step) {
  ControlChart chart;
  chart.tire = tire.name;
  for (const AlignmentMeasurement& one : tire.measurements) {
    chart.time_s.push_back(one.time_s);
    chart.rrc_N_per_kN.push_back(one.rrc_N_per_kN);
  }
  const std::size_t count = chart.rrc_N_per_kN.size();
  chart.center_N_per_kN =
      std::accumulate(chart.rrc_N_per_kN.begin(), chart.rrc_N_per_kN.end(), 0.0) / static_cast<double>(count);
  for (std::size_t i = 1; i < count; ++i) {
    chart.sd_N_per_kN += std::abs(chart.rrc_N_per_kN[i] - chart.rrc_N_per_kN[i - 1]);
    chart.largest_gap_days = std::max(chart.largest_gap_days, (chart.time_s[i] - chart.time_s[i - 1]) / kDay);
  }
  if (count < 2) return chart;
  chart.sd_N_per_kN = std::max(chart.sd_N_per_kN / (kMeanRangeOfTwo * static_cast<double>(count - 1)),
                               calc_rounding_sd(step));
  const double limit = 3.0 * chart.sd_N_per_kN + 0.5 * step;
  chart.low_N_per_kN = chart.center_N_per_kN - limit;
  chart.high_N_per_kN = chart.center_N_per_kN + limit;
  for (std::size_t i = 0; i < count; ++i) {
    const double from_center = std::abs(chart.rrc_N_per_kN[i] - chart.center_N_per_kN);
    if (from_center > limit + kRounding_N_per_kN) chart.outside.push_back(i);
  }
  chart.longest_run = find_longest_run(chart, step);
  chart.shift = find_shift({chart}, step);
  return chart;
}

std::optional<ControlDrift> find_drift(const std::vector<ControlChart>& charts, double step) {
  constexpr double kLeastFreedom = 3.0;
  const auto common = fit_common_slope(charts, step, calc_years);
  if (!common.has_value() || common->freedom < kLeastFreedom) return std::nullopt;
  double first_s = std::numeric_limits<double>::infinity(), last_s = -first_s;
  for (const ControlChart& chart : charts) {
    first_s = std::min(first_s, chart.time_s.front());
    last_s = std::max(last_s, chart.time_s.back());
  }
  ControlDrift drift;
  drift.N_per_kN_per_year = common->slope;
  drift.degrees_of_freedom = common->freedom;
  drift.p_value = common->p_value;
  const boost::math::students_t distribution(common->freedom);
  const double half = common->sd * boost::math::quantile(boost::math::complement(distribution, 0.025));
  drift.low_95 = drift.N_per_kN_per_year - half;
  drift.high_95 = drift.N_per_kN_per_year + half;
  drift.over_time_N_per_kN = drift.N_per_kN_per_year * (last_s - first_s) / kYear_s;
  return drift;
}

}  // namespace

ControlMonitoring watch_control_tires(const std::vector<ControlTire>& tires) {
  ControlMonitoring monitoring;
  std::vector<double> values;
  for (const ControlTire& tire : tires) {
    for (const AlignmentMeasurement& one : tire.measurements) values.push_back(one.rrc_N_per_kN);
  }
  const double step = find_value_step(values);
  for (const ControlTire& tire : tires) monitoring.charts.push_back(make_chart(tire, step));
  monitoring.drift = find_drift(monitoring.charts, step);
  monitoring.shift = find_shift(monitoring.charts, step);
  return monitoring;
}

bool has_drift(const ControlMonitoring& monitoring) {
  return monitoring.shift.has_value() || (monitoring.drift.has_value() && monitoring.drift->p_value < kDriftLevel);
}

bool is_out_of_control(const ControlChart& chart) {
  const bool has_limits = chart.rrc_N_per_kN.size() >= kLeastControlMeasurements;
  return chart.shift.has_value() ||
         (has_limits && (!chart.outside.empty() || chart.longest_run >= kMostOnOneSide));
}

}  // namespace rollrig::estimation
