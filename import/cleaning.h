#pragma once
/// Spikes of a log, found and taken out.

#include <vector>

#include "import/log.h"
#include "models/sensor.h"

namespace rollrig::logs {

/// Rows of `values` that stand out of their neighbours: one or two rows that leave and come back.
///
/// Equation  d_i = y_i - median of the three values to each side (of those beyond i's pair, for two rows);
///           spike where |d_i| > k s, and y_i lies outside the range of these neighbours by more than that range and
///           by more than k s; s = max(1.4826 median|d|, floor)
/// Symbols   k threshold, floor what s is not less than (noise and rounding of the sensor)
/// Validity  NaN is passed over. `is_judged` false: the row is not judged, as where the inputs jump
/// Checked   tests/import/cleaning_test.cpp
std::vector<std::size_t> find_spikes(const std::vector<double>& values, double threshold, double floor,
                                     const std::vector<bool>& is_judged);

/// Marks and takes out the spikes of all columns. Columns that carry inertia (torque, forces) are judged only where
/// the log's speed and load are steady.
void take_out_spikes(Log& log, const models::SensorSet& sensors, double threshold);

}  // namespace rollrig::logs
