#pragma once
/// Which runs of two measurement sets belong together.

#include <optional>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::comparison {

/// What a run was carried out at.
struct RunConditions {
  double speed_m_s = 0.0;  // means over the run
  double load_N = 0.0;
  double ambient_K = 0.0;
  double duration_s = 0.0;
};
RunConditions find_conditions(const measurements::MeasuredRun& run);

/// For each run of the reference, the index of its counterpart in the other set, or none. Runs of one id belong
/// together; of the others, those at the same conditions, where no second one is: speed within 1 km/h, load within 2 %,
/// cold pressure within 3 kPa, air and tire at the start within 3 K, duration within 10 %.
/// Source   Assumed: all limits
/// Checked  tests/comparison/match_runs_test.cpp
std::vector<std::optional<std::size_t>> match_runs(const std::vector<measurements::MeasuredRun>& reference,
                                                   const std::vector<measurements::MeasuredRun>& other);

}  // namespace rollrig::comparison
