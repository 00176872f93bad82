#pragma once
/// A mapping for log files of which nothing is known but the files (`rollrig import --guess`, `rollrig new set`).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/scaffold_options.h"
#include "measurements/logs/guess_form.h"
#include "measurements/logs/guess_units.h"
#include "measurements/measurement_set.h"

namespace rollrig::measurements {

/// Something that was taken to be so, and why.
struct GuessLine {
  std::string subject;  // key of the mapping, or a run
  std::string taken;
  std::string reason;
};

/// Where a column of the set comes from.
struct GuessedColumn {
  Quantity target;
  std::string heading;  // empty for a constant
  GuessedUnit unit;
  double sign = 1.0;       // -1: the log counts the other way
  double dead_band = 0.0;  // in the unit of the target
  std::optional<double> value;
  std::string reason;
};

struct GuessedTime {
  std::string heading;
  std::string form;  // as in a mapping
  std::string unit = "s";
  std::string date_heading;
  std::string date;
  std::string date_order;
  bool is_dated = false;  // the times of two files can be compared
  std::string reason;
};

struct GuessedRun : RunTable {
  std::string path;
  double start_s = 0.0, end_s = 0.0;  // on the clock of the logs
  std::string reason;
};

/// One log as text.
struct GuessedLog {
  std::string path;
  CsvTable table;
  const std::vector<std::string>& cells_of(const std::string& heading) const { return cells.at(heading); }
  std::map<std::string, std::vector<std::string>> cells;
};

/// What guesses are made from.
struct GuessSource {
  GuessOptions options;
  GuessedForm form;
  std::vector<GuessedLog> logs;
  std::vector<HeadingParts> headings;  // in the order of form.headings
  const MachineKind* kind = nullptr;
  models::TireFile tire;
  double drum_diameter_m = 0.0;  // 0 of a machine without a drum

  /// The numbers of a column in all logs, as they are written; NaN where there is none.
  std::vector<double> numbers_of(const std::string& heading) const;
  const HeadingParts& parts_of(const std::string& heading) const;
  /// A mistake or an open question about the logs, to be thrown.
  InputError problem(const std::string& what, const std::string& option, const std::string& value,
                     const std::string& allowed) const;
};

struct Guess {
  GuessSource source;
  GuessedTime time;
  std::vector<GuessedColumn> columns;
  std::vector<GuessedRun> runs;
  std::vector<std::string> unread;  // headings
  double interval_s = 0.0;          // of the rows of the logs, the median
};

/// Reads the logs and guesses. What cannot be told is an error that names the option by which to say it.
/// Errors   InputError: no logs; logs of different forms; two columns for one quantity; a column, unit, date order or
///          history of a run that the files do not tell
/// Checked  tests/measurements/logs/guess_test.cpp
Guess guess_logs(const GuessOptions& options);
/// The same with a tire that is in no file yet.
Guess guess_logs(const GuessOptions& options, const models::TireFile& tire);

/// Parts of guess_logs(), in their order.
GuessedTime guess_time(const GuessSource& source);
std::vector<GuessedColumn> guess_columns(const GuessSource& source, const GuessedTime& time);
std::vector<GuessedRun> guess_runs(const GuessSource& source, const GuessedTime& time,
                                   const std::vector<GuessedColumn>& columns);
/// The unit of a column by the size of its numbers. Throws InputError where several go or none.
GuessedUnit guess_unit_by_size(const GuessSource& source, const Quantity& target, const std::string& heading,
                               const std::vector<double>& numbers, std::string& reason);

/// The times of a log in seconds on the clock of the logs. Throws InputError at a cell that is none.
std::vector<double> read_guessed_times(const GuessSource& source, const GuessedTime& time, const GuessedLog& log);

/// Everything that was guessed, for a person.
std::vector<GuessLine> list_guesses(const Guess& guess);
/// Whether the logs are files of a set as they are (docs/formats.md), so that a set.toml is enough.
bool are_files_of_set(const Guess& guess);
/// The mapping ("rollrig-import/1") with a comment on each guess, or the set.toml. Paths in it are relative to
/// `folder`.
std::string write_guessed_mapping(const Guess& guess, const std::string& folder);
std::string write_guessed_set(const Guess& guess, const std::string& folder);

}  // namespace rollrig::measurements
