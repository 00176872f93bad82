#include "estimation/tire_fit/set_variety.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "measurements/sample_selection.h"

namespace rollrig::estimation {
namespace {

constexpr double kLongEnough_s = 60.0;  // Assumed: at a load or speed, so that it counts
constexpr double kShortShare = 0.05;    // Assumed: of the time, what does not count
constexpr double kSameValue = 0.02;     // Assumed: loads and speeds within 2 % are one

using Visit = std::function<void(const measurements::MeasuredRun& run, std::size_t row, double seconds)>;

/// Calls visit for each row at which the tire is loaded.
void visit_loaded_rows(const measurements::MeasurementSet& set, const Visit& visit) {
  for (const measurements::MeasuredRun& run : set.runs) {
    const std::vector<double>& load_N = run.column(models::quantities::kLoad);
    for (std::size_t row = 0; row + 1 < load_N.size(); ++row) {
      if (load_N[row] < measurements::kLoadedShare * set.tire.values.rolling_resistance.reference_load_N) continue;
      visit(run, row, run.time_s[row + 1] - run.time_s[row]);
    }
  }
}

/// How long the loaded tire is at each value of a channel.
std::map<double, double> collect_loaded_seconds(const measurements::MeasurementSet& set, const Quantity& channel) {
  std::map<double, double> seconds;
  visit_loaded_rows(set, [&](const measurements::MeasuredRun& run, std::size_t row, double at_value_s) {
    seconds[run.column(channel)[row]] += at_value_s;
  });
  return seconds;
}

double sum_seconds(const std::map<double, double>& seconds) {
  double total_s = 0.0;
  for (const auto& [value, at_value_s] : seconds) total_s += at_value_s;
  return total_s;
}

/// Whether the loaded tire is at values of a channel, from a least one up, that differ by a tenth.
bool is_varied(const measurements::MeasurementSet& set, const Quantity& channel, double least = 0.0) {
  constexpr double kDiffers = 1.1;  // Assumed: then the loss differs by more than sensors err
  std::map<double, double> seconds = collect_loaded_seconds(set, channel);
  seconds.erase(seconds.begin(), seconds.lower_bound(least));
  const double left_out_s = std::max(kLongEnough_s, kShortShare * sum_seconds(seconds));
  const auto find_beyond = [left_out_s](auto at, const auto end) {
    for (double passed_s = 0.0; at != end; ++at) {
      passed_s += at->second;
      if (passed_s >= left_out_s) return at->first;
    }
    return std::nan("");
  };
  return find_beyond(seconds.rbegin(), seconds.rend()) >= kDiffers * find_beyond(seconds.begin(), seconds.end());
}

/// Values within 2 % of the lowest of them.
struct Level {
  double lowest = 0.0;
  double seconds = 0.0;
};

/// Levels of a channel that last for so long, in increasing order.
std::vector<Level> find_levels(const std::map<double, double>& seconds, double least_s) {
  std::vector<Level> levels;
  for (const auto& [value, at_value_s] : seconds) {
    if (levels.empty() || value - levels.back().lowest > kSameValue * value) levels.push_back({value, 0.0});
    levels.back().seconds += at_value_s;
  }
  levels.erase(std::remove_if(levels.begin(), levels.end(), [&](const Level& at) { return at.seconds < least_s; }),
               levels.end());
  return levels;
}

/// Mean over time of what is known of it.
struct TimeMean {
  double sum = 0.0;
  double seconds = 0.0;

  void add(double value, double for_s) {
    if (std::isnan(value)) return;
    sum += value * for_s;
    seconds += for_s;
  }
  double mean_or(double other) const { return seconds > 0.0 ? sum / seconds : other; }
};

SpeedConditions average(const measurements::MeasurementSet& set, const Level& level) {
  TimeMean speed_m_s, load_N, pressure_Pa, cold_Pa, liner_K;
  visit_loaded_rows(set, [&](const measurements::MeasuredRun& run, std::size_t row, double seconds) {
    const double at_m_s = run.column(models::quantities::kSpeed)[row];
    if (at_m_s < level.lowest || at_m_s - level.lowest > kSameValue * at_m_s) return;
    speed_m_s.add(at_m_s, seconds);
    load_N.add(run.column(models::quantities::kLoad)[row], seconds);
    cold_Pa.add(run.cold_pressure_Pa, seconds);
    const auto add_measured = [&](const Quantity& channel, TimeMean& mean) {
      if (run.has(channel)) mean.add(run.column(channel)[row], seconds);
    };
    add_measured(models::quantities::kCavityPressure, pressure_Pa);
    add_measured(models::quantities::kLinerTemperature, liner_K);
  });
  constexpr double kUsual_dK = 30.0;  // Assumed: at which the bounded law states its loss
  return {speed_m_s.mean_or(0.0), load_N.mean_or(0.0), pressure_Pa.mean_or(cold_Pa.mean_or(0.0)),
          liner_K.mean_or(kZeroCelsius_K + kUsual_dK)};
}

}  // namespace

Variety find_variety(const measurements::MeasurementSet& set) {
  return {is_varied(set, models::quantities::kSpeed, measurements::kTrustedSpeed_m_s),
          is_varied(set, models::quantities::kLoad)};
}

std::vector<double> find_loads_N(const measurements::MeasurementSet& set) {
  std::vector<double> loads_N;
  for (const Level& level : find_levels(collect_loaded_seconds(set, models::quantities::kLoad), kLongEnough_s)) {
    loads_N.push_back(level.lowest);
  }
  return loads_N;
}

std::vector<SpeedConditions> find_speeds(const measurements::MeasurementSet& set) {
  std::map<double, double> seconds = collect_loaded_seconds(set, models::quantities::kSpeed);
  seconds.erase(seconds.begin(), seconds.lower_bound(measurements::kTrustedSpeed_m_s));
  std::vector<SpeedConditions> speeds;
  const double least_s = std::max(kLongEnough_s, kShortShare * sum_seconds(seconds));
  for (const Level& level : find_levels(seconds, least_s)) speeds.push_back(average(set, level));
  return speeds;
}

}  // namespace rollrig::estimation
