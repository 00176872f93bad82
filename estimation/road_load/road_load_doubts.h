#pragma once
/// What is odd about a road load for the mass of its vehicle.

#include <optional>
#include <string>
#include <vector>

#include "models/vehicle/road_load.h"

namespace rollrig::estimation {

/// Rolling loss at 50 km/h over the weight.
double calc_rolling_share(const models::RoadLoad<double>& load, double mass_kg);

/// What speaks against the units of the data or against the mass, one sentence each: a rolling loss and a drag area
/// that would be usual if the speeds were in mph or in m/s; else a rolling loss or a drag area that road vehicles do
/// not have. `top_speed_m_s` is the highest speed of the data.
/// Checked   tests/estimation/road_load_doubts_test.cpp
std::vector<std::string> doubt_road_load(const models::RoadLoad<double>& load, double mass_kg, double top_speed_m_s);

/// What speaks against a force that was found by the torque of the wheels, whose rolling loss and drag area would both
/// be usual if it were twice as large: a diameter for the radius, or the torque of one wheel of two.
/// Checked   tests/estimation/road_load_doubts_test.cpp
std::optional<std::string> doubt_torque_scale(const models::RoadLoad<double>& load, double mass_kg, double radius_m);

/// What speaks against masses, one sentence each: a rotating mass that is no part of a vehicle's, a mass to correct to
/// that is far from the one as tested. Absent masses are not doubted.
/// Checked   tests/estimation/road_load_doubts_test.cpp
std::vector<std::string> doubt_masses(double mass_kg, const std::optional<double>& rotating_mass_kg,
                                      const std::optional<double>& corrected_to_mass_kg);

}  // namespace rollrig::estimation
