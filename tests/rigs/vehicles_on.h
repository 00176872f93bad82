#pragma once
/// The vehicles of the tests on a kind of rig, names of the fidelities, and the city cycle.

#include <string>
#include <vector>

#include "scenarios/common/speed_trace.h"
#include "tests/support/vehicle_fixture.h"

namespace rollrig::tests {

inline const char* name_of(bool multibody) { return multibody ? "multibody" : "quasi-static"; }

/// Every vehicle of a kind of rig: quarters at both axles, and the whole.
inline std::vector<VehicleFixture> all_on(const std::string& rig) {
  return {VehicleFixture(rig, false, kFront), VehicleFixture(rig, false, kRear), VehicleFixture(rig, true)};
}

/// The city cycle, UDDS.
inline sim::Program city() {
  const scenarios::SpeedTrace trace = scenarios::read_speed_trace("udds");
  sim::Phase phase = driving("city", 1.0, 0.0, 0.0);
  phase.segments.clear();
  for (std::size_t i = 0; i + 1 < trace.time_s.size(); ++i) {
    phase.segments.push_back(
        vehicle_segment(trace.time_s[i + 1] - trace.time_s[i], trace.speed_m_s[i], trace.speed_m_s[i + 1]));
    phase.segments.back().max_step_s = 0.0;
  }
  return make_program({phase});
}

}  // namespace rollrig::tests
