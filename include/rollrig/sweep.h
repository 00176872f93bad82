#pragma once
/// A scenario at every point of a grid of settings.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "run.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// A setting with the values that it takes.
struct SweepAxis {
  std::string key;                  // as in RunInput::settings
  std::vector<std::string> values;  // in the unit of the key
};

constexpr std::size_t kMostSweepPoints = 10000;  // Assumed: each takes memory for its result and manifest

/// "key=a,b,c" or "key=from:to:step". Throws InputError.
SweepAxis read_sweep_axis(const std::string& text);

struct SweepInput {
  RunInput run;
  std::vector<SweepAxis> axes;         // at most kMostSweepPoints combinations
  std::vector<std::string> shown;      // results in the report's table and charts; none: those that change
  int threads = 0;                     // 0: as many as the machine has
  std::string unfinished_folder = {};  // where finished points are saved until the sweep is complete; empty: nowhere
};

/// One row for each point, the last axis fastest. Its files: sweep.csv, sweep.json, and manifests.json with the
/// manifest of each point that could be simulated.
struct SweepResult : Report {
  std::vector<std::string> axes;                 // keys
  std::vector<std::vector<std::string>> points;  // values of the axes
  std::vector<std::string> results;              // names of all results; of a list's: "cycles.1.load_N"
  std::vector<std::vector<double>> values;       // of each point the results; NaN where it has none
  std::vector<std::string> failures;             // of each point why it could not be simulated, empty where it could

  std::size_t count_failures() const;
};

/// A sweep whose runs are all read and checked. Copies share it; any number of threads may use it.
class Sweep {
 public:
  /// Throws InputError, also for a result to be shown that the scenario does not have, and where
  /// SweepInput::unfinished_folder holds another sweep or another process uses it. It is this sweep's alone while a
  /// copy is there.
  explicit Sweep(const SweepInput& input);
  /// Runs all points, several at a time. If SweepInput::unfinished_folder has points of an interrupted sweep, it runs
  /// the others; one call at a time, and the folder is removed if all points fail. A point that fails is named in the
  /// result. Throws InputError for a result to be shown that no point has; RunFailure where all points fail;
  /// Interrupted.
  SweepResult carry_out(const Progress& progress = {}) const;
  /// Removes the points that SweepInput::unfinished_folder holds, once the result is written; and the folder, if it is
  /// empty then.
  void remove_unfinished() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace rollrig
#pragma GCC visibility pop
