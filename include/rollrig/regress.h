#pragma once
/// Whether runs give the same results as before. A folder has run files (<name>.toml), and beside each its golden
/// (<name>.golden.csv): the former results with their tolerances.

#include <cstddef>
#include <string>
#include <vector>

#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// Comparison of a run with its golden.
struct GoldenComparison {
  std::size_t compared = 0;           // number of values
  std::vector<std::string> problems;  // one line each, with the quantity; empty where all is within its tolerance
  std::string worst_quantity;         // "result.<key>", or a channel and its time
  double worst_share = 0.0;           // |difference| / tolerance of this quantity
};

/// A run of the folder. Its status is "same", "differs", "failed", "no golden", "no run file", "bad golden", "bad run
/// file" or "updated"; the problems of a run that failed or has a bad file are the message of the error.
struct RegressedRun : GoldenComparison {
  std::string name;  // of its files, without their endings
  std::string status = {};
  std::string golden = {};  // the file as it would be written now; empty where the run has no results
};

/// As a report without files.
struct Regression : Report {
  std::string folder;
  std::vector<RegressedRun> runs;  // sorted by name, then goldens without a run file
};

struct RegressionOptions {
  int threads = 0;  // 0: as many as the machine has
  Progress progress = {};
};

/// Carries out all runs of a folder (empty: that of the assets), and compares them with their goldens. A run that is
/// wrong or fails is noted in its status, and the others go on.
/// Errors  InputError: no run files in the folder; Interrupted
Regression regress(const std::string& folder = "", const RegressionOptions& options = {});

/// Writes the golden of each run that differs, has none or has a bad one; the run is then "updated". The tolerances of
/// a golden that can be read stay. All files are written before the first takes its place: if one cannot be written, no
/// golden changes.
/// Example  const Regression updated = update_goldens(regress("runs"));
/// Errors   InputError: a golden cannot be written
Regression update_goldens(Regression found);

}  // namespace rollrig
#pragma GCC visibility pop
