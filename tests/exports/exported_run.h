#pragma once
/// A run as rollrig writes it, for the tests of what is exported of it.

#include <stdexcept>

#include "sim/core/csv.h"
#include "tests/support/run_program.h"

namespace rollrig::tests {

/// Folder `result` of a warm-up with sensors, folder `set` of the same as a measurement set.
class ExportedRun {
 public:
  ExportedRun() {
    const auto run = run_program(
        "run warm_up --tire a50 --fidelity quasi_static --sensors source --out result --write-set set --quiet",
        folder_.path());
    if (run.status != 0) throw std::runtime_error(run.err);
  }

  std::string result() const { return folder_.file("result"); }
  std::string set() const { return folder_.file("set"); }
  CsvTable recording() const { return CsvTable::read(folder_.file("result/recording.csv")); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

}  // namespace rollrig::tests
