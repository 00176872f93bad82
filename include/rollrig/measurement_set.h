#pragma once
/// Measurement sets: a folder with set.toml and one CSV for each run (docs/formats.md). What a run of a scenario writes
/// as a set is in its result (rollrig/run.h).

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bad_rows.h"
#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// One run of a set.
struct MeasuredRun {
  std::string id;
  std::string session;  // runs of one session share the offsets of the sensors
  double initial_tire_temperature_K = 0.0;
  double cold_pressure_Pa = 0.0;  // gauge, at that temperature
  std::optional<double> rest_before_s;
  std::vector<double> time_s;
  std::vector<Channel> columns;
};

/// What a look at a file or a set says.
struct FileCheck {
  std::string what;                        // "tire 'a50'"
  std::vector<std::string> warnings = {};  // a sentence each
  bool is_good = true;                     // false for a set whose columns or units cannot be what they are said to be,
                                           // and for a tire whose loss is negative where it is valid
};

/// A measurement set with all that it names, read and checked. Copies share it; any number of threads may use it.
class MeasurementSet {
 public:
  /// `folder` may be the path of the set.toml. Throws InputError.
  explicit MeasurementSet(const std::string& folder, BadRows bad_rows = BadRows::kRefuse);

  const std::string& name() const;
  /// The kind of machine as files have it, for example "drum", "flat_belt", "roller", "road".
  std::string kind() const;
  /// Name of its tire.
  const std::string& tire() const;
  std::vector<MeasuredRun> list_runs() const;

  struct Data;
  const Data& data() const { return *data_; }  // for the library itself, as the next one
  explicit MeasurementSet(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

 private:
  std::shared_ptr<const Data> data_;
};

/// Looks at a file of any format of rollrig, at a cycle's CSV, or at the folder of a set. A set is held against the
/// simulation as well, since exchanged columns and wrong units are in no single number.
/// Errors  InputError: the file is wrong; RunFailure: a set cannot be simulated
FileCheck check_file(const std::string& path, BadRows bad_rows = BadRows::kRefuse, const Progress& progress = {});

/// Joins a torque log and a tire log, each on a clock of its own, into a measurement set (docs/import.md). `mapping` is
/// a .toml file, `data` the folder of the logs, empty: that of the mapping. The report has the files of the set, with
/// import.json and marks.csv beside them, and no page.
/// Errors  InputError: a wrong mapping or log; clocks that cannot be found
Report import_logs(const std::string& mapping, const std::string& data = "", BadRows bad_rows = BadRows::kRefuse,
                   const Progress& progress = {});

/// Folders right in `folder` that are sets, sorted by name; none where `folder` is a set itself.
std::vector<std::string> find_sets(const std::string& folder);
/// Folders right in `folder` that hold CSV files and no set.toml, sorted by name.
std::vector<std::string> find_undescribed_folders(const std::string& folder);

}  // namespace rollrig
#pragma GCC visibility pop
