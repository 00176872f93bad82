#pragma once
/// Two logs on clocks of their own, joined into a measurement set (`rollrig import`).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/progress.h"
#include "measurements/logs/resample.h"
#include "sim/core/json.h"

namespace rollrig::measurements {

struct ImportedRun {
  RunPlan plan;
  ResampledRun rows;
  std::optional<std::size_t> clock;  // index of Import::clocks
};

struct Import {
  std::vector<Log> logs;  // each file once
  std::vector<ClockEstimate> clocks;
  std::vector<ImportedRun> runs;
  models::SensorSet sensors;  // for the set's rows
  std::vector<std::string> warnings;
};

/// Reads the logs, finds the clocks (one for each pair of files), resamples.
/// Source   thesis B.1: torque and temperature are logged apart, by their own clocks, and are to be synchronized
/// Errors   InputError, see read_log, estimate_clock, resample_run; bad rows of all logs are in one error, or marked
///          and left out where they are at most 5 % of a log (Assumed)
/// Checked  tests/measurements/logs/import_test.cpp
Import import_logs(const Mapping& mapping, BadRows bad_rows = BadRows::kRefuse, const Progress& progress = {});

/// set.toml, tire.toml, rig.toml or vehicle.toml, a CSV a run; marks.csv and import.json beside them.
std::map<std::string, std::string> make_set_files(const Mapping& mapping, const Import& imported);

/// "rollrig-import-report/1".
Json make_import_json(const Mapping& mapping, const Import& imported);

}  // namespace rollrig::measurements
