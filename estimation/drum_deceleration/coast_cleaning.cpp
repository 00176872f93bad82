#include "estimation/drum_deceleration/coast_cleaning.h"

#include <algorithm>
#include <cmath>

#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

constexpr std::size_t kNeighbors = 5;  // to each side; five wrong ones of eleven do no harm
constexpr double kTopShare = 0.98;     // of the highest speed: the coast has begun
constexpr double kSlowest_m_s = 0.5;   // below, a body is as good as at rest
constexpr std::size_t kFewestRows = 20;

/// Running median, narrower towards the ends so that it stays centered and does not lag a falling speed.
std::vector<double> calc_running_median(const std::vector<double>& values) {
  std::vector<double> medians(values.size());
  std::vector<double> window;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t reach =
        std::min({kNeighbors, std::max<std::size_t>(i, 2), std::max<std::size_t>(values.size() - 1 - i, 2)});
    const std::size_t first = i > reach ? i - reach : 0;
    const std::size_t last = std::min(values.size() - 1, i + reach);
    window.assign(values.begin() + static_cast<std::ptrdiff_t>(first),
                  values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
    std::nth_element(window.begin(), middle, window.end());
    medians[i] = *middle;
  }
  return medians;
}

/// Rows before a body came to rest, after which its last speed is repeated.
std::size_t count_moving(const std::vector<double>& speed_m_s) {
  constexpr std::size_t kRepeats = 3;
  std::size_t first_alike = speed_m_s.size();
  while (first_alike > 0 && speed_m_s[first_alike - 1] == speed_m_s.back()) --first_alike;
  return speed_m_s.size() - first_alike >= kRepeats ? first_alike : speed_m_s.size();
}

/// Whether a row is kept; counts it by its kind otherwise.
bool judge_pulse(double ratio, Coast& coast) {
  const auto near = [ratio](double to) { return std::abs(ratio / to - 1.0) < 0.2; };
  if (std::abs(ratio - 1.0) <= 0.25) return true;
  if (near(0.5) || near(1.0 / 3.0)) {
    ++coast.missed;
  } else if (near(2.0)) {
    ++coast.doubled;
  } else {
    ++coast.other;
  }
  return false;
}

double calc_largest_rise(const std::vector<double>& smooth_m_s) {
  double lowest = smooth_m_s.front();
  double rise = 0.0;
  for (const double speed : smooth_m_s) {
    lowest = std::min(lowest, speed);
    rise = std::max(rise, speed - lowest);
  }
  return rise;
}

}  // namespace

Coast find_coast(const CoastSeries& series, const std::optional<double>& pulse_length_m, const CoastRun& run) {
  Coast coast;
  const std::size_t moving = count_moving(series.speed_m_s);
  coast.stopped = series.speed_m_s.size() - moving;
  std::vector<double> median =
      calc_running_median({series.speed_m_s.begin(), series.speed_m_s.begin() + static_cast<std::ptrdiff_t>(moving)});
  std::size_t start = 0;
  const double top = median.empty() ? 0.0 : *std::max_element(median.begin(), median.end());
  for (std::size_t i = 0; i < moving; ++i) {
    if (median[i] >= kTopShare * top) start = i;
  }
  for (std::size_t i = start; i < moving; ++i) {
    if (median[i] < kSlowest_m_s || series.speed_m_s[i] <= 0.0) continue;
    if (!judge_pulse(series.speed_m_s[i] / median[i], coast)) continue;
    const double half_period_s = pulse_length_m.has_value() ? *pulse_length_m / (2.0 * series.speed_m_s[i]) : 0.0;
    coast.time_s.push_back(series.time_s[i] - half_period_s);
    coast.speed_m_s.push_back(series.speed_m_s[i]);
  }
  if (coast.time_s.size() < kFewestRows) {
    throw InputError({"the run has no coast: too few rows after the highest speed", run.file, 0, "", "",
                      "a record that goes on, twenty rows at least, after the drive is let go", ""});
  }
  coast.start_s = coast.time_s.front();
  coast.smooth_m_s = calc_running_median(coast.speed_m_s);
  coast.rise_m_s = calc_largest_rise(coast.smooth_m_s);
  return coast;
}

}  // namespace rollrig::estimation
