#include "identification/sample_selection.h"

#include <algorithm>
#include <cmath>

namespace rollrig::identification {

double find_acceleration(const scenarios::MeasuredRun& run, std::size_t row) {
  const std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
  const std::size_t first = std::min(row, run.time_s.size() - 2);
  return (speed_m_s[first + 1] - speed_m_s[first]) / (run.time_s[first + 1] - run.time_s[first]);
}

std::vector<bool> find_settled_rows(const scenarios::MeasuredRun& run) {
  constexpr double kSameLoad = 0.01;  // Assumed: load control holds to 1 %
  constexpr double kKink_m_s2 = 0.1;  // Assumed: change of acceleration that disturbs the torque
  const std::vector<double>& load_N = run.columns.at("load_N");
  const std::vector<double>& speed_m_s = run.columns.at("speed_km_h");
  const std::size_t n = run.time_s.size();
  std::vector<bool> settled(n, true);
  double disturbed_s = run.time_s.front() - kSettling_s;  // a run starts in equilibrium
  for (std::size_t row = 0; row < n; ++row) {
    if (row > 0) {
      const bool load_changed =
          std::abs(load_N[row] - load_N[row - 1]) > kSameLoad * std::max(load_N[row], load_N[row - 1]);
      const bool kinked = std::abs(find_acceleration(run, row) - find_acceleration(run, row - 1)) > kKink_m_s2;
      if (load_changed || kinked) {
        disturbed_s = run.time_s[row];
        settled[row - 1] = false;  // its averaging interval may reach into the change
      }
    }
    settled[row] = run.time_s[row] >= disturbed_s + kSettling_s && speed_m_s[row] >= kTrustedSpeed_m_s;
  }
  return settled;
}

}  // namespace rollrig::identification
