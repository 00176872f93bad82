#pragma once
/// What a simulation may not know of a channel: the parts that tell mistakes from effects.

#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// Parts that a simulation may not know (columns of B in mistake_evidence.h), values in every row of a run.
struct Unknowns {
  std::vector<std::vector<double>> scaled;  // their size is unknown
  std::vector<std::vector<double>> fixed;
};

Unknowns list_unknowns(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run,
                       const Quantity& channel, const std::vector<double>& simulated);

}  // namespace rollrig::diagnosis
