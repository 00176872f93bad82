#pragma once
/// Parts of a channel that a simulation may not know, so that effects are not taken for mistakes.

#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// Parts that a simulation may not know (columns of B in mistake_evidence.h), values in every row of a run.
struct Unknowns {
  std::vector<std::vector<double>> scaled;  // in proportion to the unknown size s
  std::vector<std::vector<double>> fixed;   // of a size of their own
};

Unknowns list_unknowns(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                       const Quantity& channel, const std::vector<double>& simulated);

}  // namespace rollrig::diagnosis
