#pragma once
/// rollrig's baseline along a recorded run on a dynamometer or the road, by its models alone, step by step in the
/// test's own way.

#include <map>
#include <string>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::tests {

/// Channels of `run` as the baseline with the files' parameters has them: means over the sampling intervals, SI.
std::map<std::string, std::vector<double>> resimulate_vehicle(const measurements::MeasurementSet& set,
                                                              const measurements::MeasuredRun& run);

}  // namespace rollrig::tests
