#pragma once
/// Goldens of regression runs: what came out, with the tolerance of each value written beside it.

#include <string>
#include <vector>

#include "include/rollrig/regress.h"
#include "scenarios/run/scenario.h"

namespace rollrig::scenarios {

/// One value of a golden file (columns quantity, time_s, value, absolute_tolerance, relative_tolerance).
struct GoldenValue {
  std::string quantity;  // "result.rrc_N_per_kN", or a channel
  double time_s = 0.0;   // NaN for a result
  double value = 0.0;
  double absolute_tolerance = 0.0;
  double relative_tolerance = 0.0;

  double tolerance() const;
};

/// Every number of the result and about 30 samples of every channel, with default tolerances.
std::vector<GoldenValue> make_golden(const Outcome& outcome);
/// Keeps the tolerances that `former` gives to the same quantity and time.
void keep_tolerances(const std::vector<GoldenValue>& former, std::vector<GoldenValue>& golden);
GoldenComparison compare_with_golden(const std::vector<GoldenValue>& golden, const std::vector<GoldenValue>& now);

std::vector<GoldenValue> read_golden(const std::string& path);
std::string write_golden(const std::vector<GoldenValue>& golden);

}  // namespace rollrig::scenarios
