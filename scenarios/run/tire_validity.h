#pragma once
/// Whether a run left the range in which its tire was measured.

#include <string>
#include <vector>

#include "models/tire/tire_file.h"
#include "sim/recording.h"

namespace rollrig::scenarios {

/// A sentence for each quantity of a run that leaves [validity] of a tire: speed, load, temperature of the liner. Of
/// the load, the highest is compared, since a skim test is below all ranges. Of a vehicle, all wheels are compared.
/// Checked tests/scenarios/tire_validity_test.cpp
std::vector<std::string> list_validity_warnings(const std::string& tire, const models::TireValidity& range,
                                                const sim::Recording<double>& recording);

}  // namespace rollrig::scenarios
