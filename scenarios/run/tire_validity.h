#pragma once
/// Whether a run left the range for which its tire file is valid.

#include <string>
#include <vector>

#include "models/tire/tire_file.h"
#include "sim/recording.h"

namespace rollrig::scenarios {

/// A sentence for each quantity of a run that leaves [validity] of a tire: speed, load, temperature of the liner. Of
/// the load, the highest is compared, since a skim test is below all ranges. Of a vehicle, the extremes of all wheels
/// are compared with each of its tires, so that one with different tires may be warned of without need.
/// Checked tests/scenarios/tire_validity_test.cpp
std::vector<std::string> list_validity_warnings(const std::string& tire, const models::TireValidity& range,
                                                const sim::Recording<double>& recording);

}  // namespace rollrig::scenarios
