#include "scenarios/common/speed_trace.h"

#include <filesystem>

#include "sim/core/assets.h"
#include "sim/core/csv.h"

namespace rollrig::scenarios {

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
