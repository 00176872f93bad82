#pragma once
/// Sensors that stand still while they should move.

#include <string>
#include <vector>

#include "diagnosis/checks/plausibility.h"

namespace rollrig::diagnosis {

/// Rows of a channel that say nothing.
struct DoubtfulRows {
  std::size_t run = 0;
  Quantity channel;
  std::size_t first_row = 0;
  std::size_t last_row = 0;  // inclusive
};

struct Stuck {
  std::vector<DoubtfulRows> rows;
  std::vector<std::string> warnings;  // a sentence for each
};

/// Stretches of 30 samples and 60 s at least in which a channel holds one number while the simulation moves
/// by more than six times the sensor's noise and resolution. Runs that cannot be simulated are passed over.
/// Validity  a sensor stuck while nothing moves cannot be told from one that works, and does no harm
/// Source    Assumed: 30 samples, 60 s, six times
/// Checked   tests/diagnosis/left_out_samples_test.cpp
Stuck find_stuck(const measurements::MeasurementSet& set, const BaselineRuns& baseline);

}  // namespace rollrig::diagnosis
