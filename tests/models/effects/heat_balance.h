#pragma once
/// The heat balance of a corner that is fed by hand.

#include <catch2/catch.hpp>

#include "tests/support/hand_fed_corner.h"

namespace rollrig::tests {

/// What is stored is what comes in less what leaves to air and road.
inline void check_heat_balance(HandFedCorner<double>& at) {
  const double stored_W = at.stored_heat_rate_W();
  const auto& heat = at.now.heat;
  CHECK(stored_W == Approx(heat.heat_in_W - heat.to_air_W - heat.to_road_W).margin(1e-3));
}

}  // namespace rollrig::tests
