#pragma once
/// Drive cycles: assets/cycles/<name>.csv, a speed trace with straight lines between its rows.

#include <optional>
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

/// A question about times or speeds where a cycle asks for more than any car does, such as minutes read as seconds.
/// Assumed: 10 m/s2; the cycles of the assets have 3.8 at most
std::optional<std::string> doubt_acceleration(const SpeedTrace& trace);

/// A question about times where a cycle changes its speed less than any drive, such as milliseconds read as seconds.
/// Assumed: 0.02 m/s2, a fifth of what a car loses that coasts; speeds that differ by less than 5 m/s are held
std::optional<std::string> doubt_slowness(const SpeedTrace& trace);

/// A question about a hole in a cycle with rows at equal intervals.
/// Assumed: equal are nine of ten within 1 %; a hole has 20 intervals, so that a standstill of vertices is none
std::optional<std::string> doubt_hole(const SpeedTrace& trace);

/// All questions about a cycle.
std::vector<std::string> doubt_trace(const SpeedTrace& trace);

/// Reads a cycle by name or path. Throws InputError.
SpeedTrace read_speed_trace(const std::string& name_or_path);

}  // namespace rollrig::scenarios
