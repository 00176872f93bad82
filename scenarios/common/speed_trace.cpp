#include "scenarios/common/speed_trace.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "sim/core/assets.h"
#include "sim/core/csv.h"

namespace rollrig::scenarios {

double calc_distance_m(const std::vector<double>& time_s, const std::vector<double>& speed_m_s) {
  double distance_m = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    distance_m += 0.5 * (speed_m_s[i - 1] + speed_m_s[i]) * (time_s[i] - time_s[i - 1]);
  }
  return distance_m;
}

std::optional<std::string> doubt_acceleration(const SpeedTrace& trace) {
  constexpr double kMost_m_s2 = 10.0;
  double most_m_s2 = 0.0;
  double at_s = 0.0;
  for (std::size_t i = 1; i < trace.time_s.size(); ++i) {
    const double rate_m_s2 =
        (trace.speed_m_s[i] - trace.speed_m_s[i - 1]) / (trace.time_s[i] - trace.time_s[i - 1]);
    if (std::abs(rate_m_s2) <= std::abs(most_m_s2)) continue;
    most_m_s2 = rate_m_s2;
    at_s = trace.time_s[i - 1];
  }
  if (std::abs(most_m_s2) <= kMost_m_s2) return std::nullopt;
  return fmt::format("cycle '{}' asks for {:.3g} m/s2 from time_s = {:g} on, which no car does: are its times in s?",
                     trace.name, most_m_s2, at_s);
}

SpeedTrace read_speed_trace(const std::string& name_or_path) {
  const std::string path = find_asset("cycles", name_or_path);
  const CsvTable csv = CsvTable::read(path);
  csv.require_known({"time_s", "speed_km_h"});
  SpeedTrace trace;
  trace.name = std::filesystem::path(path).stem().string();
  trace.time_s = csv.increasing_times("time_s");
  if (csv.row_count() < 2) {
    throw InputError({"a cycle of one row goes nowhere", path, csv.line_of(0), "time_s", "", "two rows at least", ""});
  }
  trace.speed_m_s = csv.numbers({"speed_km_h", between(0.0, 400.0), "speed"});
  return trace;
}

}  // namespace rollrig::scenarios
