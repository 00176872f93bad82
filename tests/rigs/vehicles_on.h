#pragma once
/// The vehicles of the tests on a kind of rig, and names of the fidelities.

#include <string>
#include <vector>

#include "tests/support/vehicle_fixture.h"

namespace rollrig::tests {

inline const char* name_of(bool multibody) { return multibody ? "multibody" : "quasi-static"; }

/// Every vehicle of a kind of rig: quarters at both axles, and the whole.
inline std::vector<VehicleFixture> all_on(const std::string& rig) {
  return {VehicleFixture(rig, false, kFront), VehicleFixture(rig, false, kRear), VehicleFixture(rig, true)};
}

}  // namespace rollrig::tests
