#pragma once
/// Samples that stand alone: spikes, and what a logger writes where it has none.

#include <cstddef>
#include <vector>

#include "sim/core/quantity.h"

namespace rollrig::measurements {

/// Rows of `values` that stand out of their neighbors: one or two rows that leave and come back.
///
/// Equation  d_i = y_i - median of the three values to each side (of those beyond i's pair, for two rows);
///           spike where |d_i| > k s, and y_i lies outside the range of these neighbors by more than that range and
///           by more than k s; s = max(1.4826 median|d|, floor)
/// Symbols   k threshold, floor what s is not less than (noise and rounding of the sensor)
/// Validity  NaN is passed over. `is_judged` false: the row is not judged, as where the inputs jump
/// Checked   tests/measurements/spikes_test.cpp
std::vector<std::size_t> find_spikes(const std::vector<double>& values, double threshold, double floor,
                                     const std::vector<bool>& is_judged);

/// Rows where speed (within 1 km/h), load and longitudinal force (within 5 % of their largest) stay as they are
/// three rows to each side. A column that is not there says nothing.
/// Source  Assumed: all limits
std::vector<bool> find_steady_rows(const QuantityMap<std::vector<double>>& columns, std::size_t rows);

/// Whether a column holds what accelerating takes, so that it may jump where the speed does.
bool carries_inertia(const Quantity& column);

}  // namespace rollrig::measurements
