#pragma once
/// Whether a run left the range for which its tire file is valid, and whether the loss of a tire is a loss.

#include <string>
#include <vector>

#include "models/tire/tire_file.h"
#include "scenarios/run/scenario.h"
#include "sim/recording.h"

namespace rollrig::scenarios {

/// A sentence for each quantity of a run that leaves [validity] of a tire: speed, load, temperature of the liner. Of
/// the load, the highest is compared, since a skim test is below all ranges. Of a vehicle, the extremes of all wheels
/// are compared with each of its tires, so that one with different tires may be warned of without need.
/// Checked tests/scenarios/tire_validity_test.cpp
std::vector<std::string> list_validity_warnings(const std::string& tire, const models::TireValidity& range,
                                                const sim::Recording<double>& recording);

/// A sentence for each line A0 + A1 v of a tire's loss that is negative within its validity, from lowest_speed_km_h to
/// highest_speed_km_h. At the loads and temperatures of the validity the loss has the sign of A. Laws other than these
/// lines have no negative loss. Where the file gives no validity, the highest speed is 120 km/h. Assumed: the 120 km/h
/// Checked tests/scenarios/tire_validity_test.cpp
std::vector<std::string> list_negative_losses(const models::TireFile& tire);

/// No tire gives energy to the motion: throws RunFailure where the rolling resistance of a recording drives a wheel
/// that rolls faster than 1 m/s, by more than 1e-6 of the largest resistance. The message has time, speed and
/// temperature of the first such row, and the key of the tire files that may cause it.
/// Checked tests/scenarios/tire_validity_test.cpp
void require_loss(const std::vector<const models::TireFile*>& tires, const sim::Recording<double>& recording);

/// Whether the loss of tires is simulated. On the road, a measured road load of the vehicle includes its tires.
bool has_tire_loss(const RunSpec& spec);

}  // namespace rollrig::scenarios
