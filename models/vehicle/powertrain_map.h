#pragma once
/// Power of the battery by the power at the driven hubs: one efficiency, or a map of it over speed and power.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/core/scalar.h"

namespace rollrig::models {

/// Efficiency over speed and power at the hubs of the whole vehicle; a negative power is recuperated. Both axes rise,
/// with two values or more each; `efficiency` has a row for each speed with a value for each power.
struct PowertrainMap {
  std::vector<double> speeds_m_s;
  std::vector<double> powers_W;
  std::vector<std::vector<double>> efficiency;
};

/// Where a value lies on an axis: between the points `below` and `below` + 1, at `share` of the way.
template <class S>
struct MapPlace {
  std::size_t below = 0;
  S share{};
};

/// At the ends of the axis, the nearest point counts.
template <class S>
MapPlace<S> find_map_place(const std::vector<double>& axis, const S& value) {
  const double plain = std::clamp(value_of(value), axis.front(), axis.back());
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, plain);
  const auto below = static_cast<std::size_t>(above - axis.begin()) - 1;
  const bool inside = plain == value_of(value);
  const S held = inside ? value : S(plain);
  return {below, S((held - S(axis[below])) / S(axis[below + 1] - axis[below]))};
}

/// Efficiency at a speed and a power.
/// Equation  bilinear between the four points around; outside the map, that of the nearest edge
/// Symbols   v speed [m/s], P power at the hubs [W]
/// Validity  steady states: a map has no history
/// Source    Assumed: bilinear
/// Checked   tests/models/powertrain_map_test.cpp
template <class S>
S calc_map_efficiency(const PowertrainMap& map, const S& speed_m_s, const S& power_W) {
  const MapPlace<S> v = find_map_place(map.speeds_m_s, speed_m_s);
  const MapPlace<S> p = find_map_place(map.powers_W, power_W);
  const auto at = [&](std::size_t row, std::size_t column) {
    return S(map.efficiency[v.below + row][p.below + column]);
  };
  const S low = at(0, 0) + (at(0, 1) - at(0, 0)) * p.share;
  const S high = at(1, 0) + (at(1, 1) - at(1, 0)) * p.share;
  return low + (high - low) * v.share;
}

/// Power out of the battery for the powertrain, negative into it.
/// Equation  P_b = P/eta where P >= 0, P eta where P < 0; eta = eta(v, P)
/// Symbols   P power at the hubs [W], eta efficiency
/// Source    definition of the efficiency in both directions
/// Checked   tests/models/powertrain_map_test.cpp
template <class S>
S calc_battery_W(const PowertrainMap& map, const S& speed_m_s, const S& power_W) {
  const S efficiency = calc_map_efficiency(map, speed_m_s, power_W);
  return value_of(power_W) >= 0.0 ? S(power_W / efficiency) : S(power_W * efficiency);
}

}  // namespace rollrig::models
