#pragma once
/// Measurement sets side by side.

#include <string>
#include <vector>

#include "comparison/compared.h"
#include "measurements/measurement_set.h"

namespace rollrig::comparison {

/// Runs that belong together, phase by phase: means of each measured channel over the times of a phase that both runs
/// have, from its beginning, and the mean of their difference. Throws InputError for sets of different kinds of
/// machine.
Compared compare_sets(const std::vector<measurements::MeasurementSet>& sets, const std::vector<std::string>& names);

}  // namespace rollrig::comparison
