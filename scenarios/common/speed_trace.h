#pragma once
/// Drive cycles: assets/cycles/<name>.csv, a speed trace with straight lines between its rows.

#include <string>
#include <vector>

namespace rollrig::scenarios {

struct SpeedTrace {
  std::string name;
  std::vector<double> time_s;
  std::vector<double> speed_m_s;

  double duration_s() const { return time_s.back() - time_s.front(); }
};

/// Distance of a speed with straight lines between its times.
double calc_distance_m(const std::vector<double>& time_s, const std::vector<double>& speed_m_s);

/// Reads a cycle by name or path. Throws InputError.
SpeedTrace read_speed_trace(const std::string& name_or_path);

}  // namespace rollrig::scenarios
