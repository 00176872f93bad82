#include "estimation/alignment/control_tires.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace rollrig::estimation {
namespace {

constexpr double kDay = 86400.0;
constexpr double kYear_s = 365.25 * kDay;
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

/// Sum of squares about the mean, and the mean, of a part of the values.
struct PartOfValues {
  double mean = 0.0, squares = 0.0;

  PartOfValues(const std::vector<double>& values, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) mean += values[i] / static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) squares += (values[i] - mean) * (values[i] - mean);
  }
};

std::optional<ControlShift> find_shift(const ControlChart& chart, double step) {
  constexpr std::size_t kLeastOnASide = 2;
  const std::vector<double>& values = chart.rrc_N_per_kN;
  if (values.size() < kLeastControlMeasurements) return std::nullopt;
  const double count = static_cast<double>(values.size()), freedom = count - 2.0;
  double greatest_t = 0.0;
  ControlShift shift;
  for (std::size_t at = kLeastOnASide; at + kLeastOnASide <= values.size(); ++at) {
    const PartOfValues before(values, 0, at), after(values, at, values.size());
    const double sd = std::max(std::sqrt((before.squares + after.squares) / freedom), calc_rounding_sd(step));
    if (!(sd > 0.0)) continue;
    const double by = after.mean - before.mean, before_count = static_cast<double>(at);
    const double t = std::abs(by) / sd / std::sqrt(1.0 / before_count + 1.0 / (count - before_count));
    if (t <= greatest_t) continue;
    greatest_t = t;
    shift = {chart.time_s[at], by};
  }
  const double p = 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), greatest_t));
  return p * (count - 3.0) < kShiftLevel ? std::optional(shift) : std::nullopt;
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
  chart.shift = find_shift(chart, step);
  return chart;
}

/// One slope within tires of their own levels.
std::optional<ControlDrift> find_drift(const std::vector<ControlChart>& charts, double step) {
  double Sxx = 0.0, Sxy = 0.0, Syy = 0.0, freedom = -1.0;
  double first_s = std::numeric_limits<double>::infinity(), last_s = -first_s;
  for (const ControlChart& chart : charts) {
    const double count = static_cast<double>(chart.time_s.size());
    const double mean_s = std::accumulate(chart.time_s.begin(), chart.time_s.end(), 0.0) / count;
    for (std::size_t i = 0; i < chart.time_s.size(); ++i) {
      const double x = (chart.time_s[i] - mean_s) / kYear_s, y = chart.rrc_N_per_kN[i] - chart.center_N_per_kN;
      Sxx += x * x;
      Sxy += x * y;
      Syy += y * y;
    }
    freedom += count - 1.0;
    first_s = std::min(first_s, chart.time_s.front());
    last_s = std::max(last_s, chart.time_s.back());
  }
  if (freedom < 3.0 || !(Sxx > 0.0)) return std::nullopt;
  ControlDrift drift;
  drift.N_per_kN_per_year = Sxy / Sxx;
  drift.degrees_of_freedom = freedom;
  const double about = std::sqrt(std::max(0.0, Syy - Sxy * Sxy / Sxx) / freedom);
  const double sd = std::max(about, calc_rounding_sd(step)) / std::sqrt(Sxx);
  const boost::math::students_t distribution(freedom);
  const double half = sd * boost::math::quantile(boost::math::complement(distribution, 0.025));
  drift.low_95 = drift.N_per_kN_per_year - half;
  drift.high_95 = drift.N_per_kN_per_year + half;
  if (sd > 0.0) {
    const double t = std::abs(drift.N_per_kN_per_year) / sd;
    drift.p_value = 2.0 * boost::math::cdf(boost::math::complement(distribution, t));
  }
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
  return monitoring;
}

bool has_drift(const ControlMonitoring& monitoring) {
  return monitoring.drift.has_value() && monitoring.drift->p_value < kDriftLevel;
}

bool is_out_of_control(const ControlChart& chart) {
  return chart.rrc_N_per_kN.size() >= kLeastControlMeasurements &&
         (!chart.outside.empty() || chart.longest_run >= kMostOnOneSide);
}

}  // namespace rollrig::estimation
