#pragma once
/// One file of a logger: times in seconds, columns of the set in SI units.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measurements/logs/mapping.h"

namespace rollrig::measurements {

/// Something in a log that is not a value of the set.
struct Mark {
  std::string log;              // path
  int line = 0;                 // of the file; of a gap the last line before it
  Quantity column;              // of the set; without a name for a gap of whole rows
  double from_s = 0.0;          // on the log's clock
  double to_s = 0.0;            // of a gap; else as from_s
  std::optional<double> value;  // as read, in the unit of the set's column
  std::string reason;           // "no value", "out of range", "spike", "no rows", "bad field", "bad row"
};

struct Log {
  std::string file;
  std::string form;          // "torque_log" or "tire_log"
  bool is_absolute = false;  // times since 1970-01-01, else from a start of the log's own
  bool is_utc = false;       // absolute, with a known offset to UTC
  std::vector<int> line;     // of each row
  std::vector<double> time_s;
  double interval_s = 0.0;                   // median of the times between rows
  QuantityMap<std::vector<double>> columns;  // NaN where there is no value; constants are left out
  std::vector<std::string> ignored_columns;
  QuantityMap<std::size_t> dead_banded;  // values taken as 0
  std::vector<Mark> marks;

  bool has(const Quantity& column) const { return columns.count(column) > 0; }
};

/// Reads a file as the mapping says; what is out of range is marked and left out, as are empty cells and gaps.
/// Errors   InputError: a column that is not there, a cell that is no number, a stamp that is none, times that do not
///          increase, a column of which more than 1 % is out of range. With `problems`, rows and fields that are wrong
///          are noted there, and marked and left out. `report` is called with the share of the reading that is done
/// Checked  tests/measurements/logs/log_test.cpp
Log read_log(const LogForm& form, const std::string& path, RowProblems* problems = nullptr,
             const std::function<void(double)>& report = {});

/// A time of the log's clock as a mapping writes it (`from`, `to`). Throws InputError at `origin`.
double parse_log_time(const LogForm& form, const Log& log, const std::string& text, const std::string& key,
                      const Origin& origin);

}  // namespace rollrig::measurements
