#pragma once
/// What a user says about two logs: the mapping file ("rollrig-import/1", docs/import.md).

#include <optional>
#include <string>
#include <vector>

#include "measurements/logs/time_stamps.h"
#include "measurements/measurement_set.h"
#include "sim/core/csv.h"

namespace rollrig::measurements {

/// The time stamps of a log.
struct TimeColumn {
  std::string column;
  TimeForm form = TimeForm::kSeconds;
  double unit_s = 1.0;      // seconds and epoch_seconds: of one unit of the column
  std::string date_column;  // clock: the column with the date, or
  std::string date;         // the date of the first row
  std::string date_order = "ymd";
  std::optional<double> utc_offset_s;  // of stamps that do not say it
};

/// One column of a log that becomes one of the set.
struct LogColumn {
  Quantity target;     // in the set
  std::string column;  // name in the log; empty where a constant is given
  Unit unit;           // of column * factor + offset
  double factor = 1.0;
  double offset = 0.0;
  Range allowed;           // in the unit of the target
  double dead_band = 0.0;  // in the unit of the target: what is nearer to 0 is 0
  std::optional<double> constant_SI;
};

/// How the files of one logger are written.
struct LogForm {
  std::string name;  // "torque_log" or "tire_log"
  CsvForm csv;
  TimeColumn time;
  std::vector<LogColumn> columns;
  std::vector<std::string> missing;  // what stands in a cell without a value
};

/// What is known of the two clocks beforehand, and what is asked of the answer.
struct ClockPlan {
  double largest_shift_s = 600.0;     // Assumed: clocks set by hand
  double rate_sd = 100e-6;            // Assumed: two quartz clocks; 0 holds the rate
  double response_lag_sd_s = 3.0;     // Assumed: heat reaches the liner through some 1 mm of rubber, 1e-7 m2/s
  double largest_sd_s = 10.0;         // Assumed: wider is refused
  bool load_changes_at_rows = false;  // else anywhere between two rows
  std::optional<double> shift_s;      // as measured by the user, with
  std::optional<double> shift_sd_s;
};

struct RunPlan : RunTable {
  std::string torque_log;  // path
  std::string tire_log;    // path; empty where there is none
  std::string from;        // time stamps as in the torque log; empty: its first and last row
  std::string to;
  Origin origin;
};

struct Mapping {
  MeasurementSet set;           // without runs
  std::string machine_content;  // rig or vehicle, as read
  std::string baseline;         // as in set.toml
  LogForm torque_log;
  std::optional<LogForm> tire_log;
  ClockPlan clock;
  std::optional<double> interval_s;  // of the set's rows; default: that of the torque log
  double longest_given_gap_s = 5.0;  // Assumed: inputs run linearly over so much
  double spike_threshold = 7.0;      // in standard deviations
  std::vector<RunPlan> runs;
};

/// Reads a mapping; logs lie beside it or in `data_folder` where that is given. Throws InputError.
Mapping read_mapping(const std::string& path, const std::string& data_folder = "");
/// The same for a mapping that is not written yet; `path` is where it would stand.
Mapping read_mapping(const ConfigTable& config, const std::string& path, const std::string& data_folder = "");

}  // namespace rollrig::measurements
