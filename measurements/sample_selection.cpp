#include "measurements/sample_selection.h"

#include <algorithm>
#include <cmath>

namespace rollrig::measurements {

namespace {

bool is_load_change(const std::vector<double>& load_N, std::size_t row) {
  constexpr double kSameLoad = 0.01;  // Assumed: load control holds to 1 %
  return row > 0 && std::abs(load_N[row] - load_N[row - 1]) > kSameLoad * std::max(load_N[row], load_N[row - 1]);
}

double find_acceleration(const std::vector<double>& time_s, const std::vector<double>& speed_m_s, std::size_t row) {
  const std::size_t first = std::min(row, time_s.size() - 2);
  return (speed_m_s[first + 1] - speed_m_s[first]) / (time_s[first + 1] - time_s[first]);
}

}  // namespace

bool is_load_change(const MeasuredRun& run, std::size_t row) {
  return is_load_change(run.column(models::quantities::kLoad), row);
}

double find_acceleration(const MeasuredRun& run, std::size_t row) {
  return find_acceleration(run.time_s, run.column(models::quantities::kSpeed), row);
}

std::vector<bool> find_settled_rows(const MeasuredRun& run) {
  constexpr double kKink_m_s2 = 0.1;  // Assumed: change of acceleration that disturbs the torque
  const std::vector<double>& speed_m_s = run.column(models::quantities::kSpeed);
  const std::vector<double>& load_N = run.column(models::quantities::kLoad);
  const std::size_t n = run.time_s.size();
  std::vector<bool> settled(n, true);
  double disturbed_s = run.time_s.front() - kSettling_s;  // a run starts in equilibrium
  for (std::size_t row = 0; row < n; ++row) {
    if (row > 0) {
      const double change_m_s2 =
          find_acceleration(run.time_s, speed_m_s, row) - find_acceleration(run.time_s, speed_m_s, row - 1);
      if (is_load_change(load_N, row) || std::abs(change_m_s2) > kKink_m_s2) {
        disturbed_s = run.time_s[row];
        settled[row - 1] = false;  // its averaging interval may reach into the change
      }
    }
    settled[row] = run.time_s[row] >= disturbed_s + kSettling_s && speed_m_s[row] >= kTrustedSpeed_m_s;
  }
  return settled;
}

std::vector<std::size_t> find_compared_rows(const MeasuredRun& run, const Quantity& channel) {
  const std::vector<double>& values = run.column(channel);
  const bool is_force = rigs::is_force(channel);
  const std::vector<bool> settled = is_force ? find_settled_rows(run) : std::vector<bool>(values.size(), true);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isnan(values[row]) && settled[row]) rows.push_back(row);
  }
  return rows;
}

double calc_mean_interval_s(const MeasuredRun& run) {
  return (run.time_s.back() - run.time_s.front()) / static_cast<double>(run.time_s.size() - 1);
}

std::vector<double> find_times(const MeasuredRun& run, const std::vector<std::size_t>& rows) {
  std::vector<double> times_s;
  for (const std::size_t row : rows) times_s.push_back(run.time_s[row]);
  return times_s;
}

}  // namespace rollrig::measurements
