#pragma once
/// The phases of a measured run, found from its recorded inputs.

#include <string>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// A stretch of one load and one kind of motion.
struct RunPhase {
  std::string name;  // "skim 1", "80 km/h 5.4 kN", "speed change 2", "standstill 1"
  std::size_t first = 0;
  std::size_t last = 0;  // one past its last row
};

/// Phases of a run, in order and without a gap: they change where the load changes (by more than 1 %), and where a
/// steady speed begins or ends. Changes of speed shorter than 30 s belong to the phase that they lead to.
/// At or below `skim_limit_N` the tire is in skim (scenarios::calc_skim_limit_N).
/// Checked tests/diagnosis/run_phases_test.cpp
std::vector<RunPhase> find_phases(const measurements::MeasuredRun& run, double skim_limit_N);

}  // namespace rollrig::diagnosis
