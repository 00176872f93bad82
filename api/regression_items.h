#pragma once
/// The runs of a regression as items.

#include <string>
#include <vector>

#include "campaigns/items.h"
#include "rollrig/regress.h"

namespace rollrig {

/// The golden of a run of a folder.
std::string find_golden_file(const std::string& folder, const std::string& run);

/// Each item is a run file of the folder, simulated and compared with its golden.
class RegressionItems : public campaigns::ItemList {
 public:
  /// `runs` are names of run files without their ending. Reads them, for the files that they need.
  RegressionItems(std::string folder, std::vector<std::string> runs);

  std::size_t count() const override { return runs_.size(); }
  /// Name of the run, and the SHA-256 of each file that it reads.
  Json describe(std::size_t item) const override;
  /// As read_comparison() reads it. A run that fails, or a file with a mistake, is a result with its status.
  Json carry_out(std::size_t item, std::uint64_t seed) const override;
  /// The run file says the seed of its sensors.
  std::uint64_t calc_seed(std::size_t, std::uint64_t) const override { return 0; }

 private:
  struct Run {
    std::string name;
    Json files;  // path and SHA-256 of each
  };

  std::string folder_;
  std::vector<Run> runs_;
};

/// A run from the result of its item.
RegressedRun read_comparison(const std::string& name, const std::string& result);

}  // namespace rollrig
