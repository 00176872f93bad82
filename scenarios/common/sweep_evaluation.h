#pragma once
/// What the three sweeps have in common: RRc at each point against the value swept.

#include <vector>

#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

/// Whether a line can be drawn over these values: two of them differ.
bool has_two_values(const std::vector<double>& x);

/// Slope of ln y over ln x by least squares; both positive, two points at least.
double fit_power(const std::vector<double>& x, const std::vector<double>& y);

/// Mean of the cycles of one point: torque, skim, F_r and RRc averaged; temperatures and windows of the last.
Cycle average_cycles(const std::vector<Cycle>& cycles);

/// The loads of the source's load sweep for this tire, else ISO load, vehicle load (5400 N) and their mean.
std::vector<double> default_sweep_loads_N(const RunSpec& spec);

constexpr double kVehicleLoad_N = 5400.0;      // §3.2.1 item 2
constexpr double kVehiclePressure_Pa = 280e3;  // §3.2.3.4

}  // namespace rollrig::scenarios
