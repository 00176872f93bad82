#include "import/cleaning.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollrig::logs {
namespace {

constexpr std::size_t kSide = 3;  // neighbours to each side

double take_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The values about rows [i, i + length) of those that are there.
std::vector<double> find_neighbours(const std::vector<double>& values, std::size_t i, std::size_t length) {
  std::vector<double> found;
  for (std::size_t k = i > kSide ? i - kSide : 0; k < std::min(values.size(), i + length + kSide); ++k) {
    if (k < i || k >= i + length) found.push_back(values[k]);
  }
  return found;
}

struct Departure {
  double size = 0.0;    // from the neighbours' median
  double beyond = 0.0;  // their range, towards it
  double range = 0.0;
};

Departure calc_departure(const std::vector<double>& values, std::size_t i, std::size_t length) {
  const std::vector<double> neighbours = find_neighbours(values, i, length);
  const auto [low, high] = std::minmax_element(neighbours.begin(), neighbours.end());
  double weakest = std::numeric_limits<double>::infinity();
  double beyond = std::numeric_limits<double>::infinity();
  const double median = take_median(neighbours);
  bool up = true, down = true;
  for (std::size_t k = i; k < i + length; ++k) {
    weakest = std::min(weakest, std::abs(values[k] - median));
    beyond = std::min(beyond, std::max(values[k] - *high, *low - values[k]));
    up = up && values[k] > *high;
    down = down && values[k] < *low;
  }
  return {weakest, up || down ? beyond : 0.0, *high - *low};
}

/// Rows where speed and load stay as they are about them.
std::vector<bool> find_steady_rows(const Log& log) {
  constexpr double kSpeed_m_s = 1.0 / 3.6;  // Assumed
  constexpr double kLoadShare = 0.05;       // Assumed: of the largest load
  constexpr std::size_t kAbout = 3;
  std::vector<bool> steady(log.time_s.size(), true);
  for (const char* name : {"speed_km_h", "load_N", "longitudinal_force_N"}) {
    const auto found = log.columns.find(name);
    if (found == log.columns.end()) continue;
    const std::vector<double>& input = found->second;
    double largest = 0.0;
    for (const double value : input) largest = std::isnan(value) ? largest : std::max(largest, std::abs(value));
    const double limit = std::string(name) == "speed_km_h" ? kSpeed_m_s : kLoadShare * largest;
    for (std::size_t i = 0; i < input.size(); ++i) {
      const std::size_t last = std::min(input.size() - 1, i + kAbout);
      for (std::size_t k = i > kAbout ? i - kAbout : 0; k <= last; ++k) {
        if (!(std::abs(input[k] - input[i]) <= limit)) steady[i] = false;  // NaN is not steady
      }
    }
  }
  return steady;
}

bool carries_inertia(const std::string& column) {
  return column == "drum_torque_Nm" || column == "loss_force_N" || column == "traction_force_N" ||
         column == "longitudinal_force_N";
}

}  // namespace

std::vector<std::size_t> find_spikes(const std::vector<double>& values, double threshold, double floor,
                                     const std::vector<bool>& is_judged) {
  std::vector<std::size_t> at;  // of the values that are there
  std::vector<double> there;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    at.push_back(i);
    there.push_back(values[i]);
  }
  std::vector<std::size_t> spikes;
  if (there.size() < 4 * kSide) return spikes;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < there.size(); ++i) sizes.push_back(calc_departure(there, i, 1).size);
  const double limit = threshold * std::max(1.4826 * take_median(sizes), floor);
  const auto stands_out = [&](std::size_t i, std::size_t length) {
    if (i + length > there.size()) return false;
    const Departure departure = calc_departure(there, i, length);
    return departure.size > limit && departure.beyond > std::max(limit, departure.range);
  };
  for (std::size_t i = 1; i + 1 < there.size(); ++i) {  // an end leaves, but nothing shows that it comes back
    const std::size_t length = stands_out(i, 1) ? 1 : stands_out(i, 2) && i + 2 < there.size() ? 2 : 0;
    for (std::size_t k = i; k < i + length; ++k) {
      if (is_judged[at[k]]) spikes.push_back(at[k]);
    }
    if (length == 2) ++i;
  }
  return spikes;
}

void take_out_spikes(Log& log, const models::SensorSet& sensors, double threshold) {
  constexpr double kFloor = 0.1;  // Assumed: of given columns, in m/s, K or m
  const std::vector<bool> steady = find_steady_rows(log);
  const std::vector<bool> all(log.time_s.size(), true);
  for (auto& [name, values] : log.columns) {
    const auto sensor = sensors.find(name);
    double floor = kFloor;
    if (sensor != sensors.end()) floor = std::max(sensor->second.noise_sd, sensor->second.resolution);
    if (name == "load_N" || name == "longitudinal_force_N") continue;  // they jump as they are told to
    for (const std::size_t row : find_spikes(values, threshold, floor, carries_inertia(name) ? steady : all)) {
      log.marks.push_back({log.file, log.line[row], name, log.time_s[row], log.time_s[row],
                           unit_of_key(name).from_si(values[row]), "spike"});
      values[row] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace rollrig::logs
