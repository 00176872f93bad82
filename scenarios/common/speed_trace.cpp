#include "scenarios/common/speed_trace.h"

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
