// The city cycle (UDDS, 1369 s, 17 stops) on rollers and on the road.
#include <catch2/catch.hpp>
#include <cmath>

#include "scenarios/common/vehicle_bench.h"
#include "tests/rigs/vehicles_on.h"

using namespace rollrig;
using rigs::VehicleIntegral;
using tests::city;
using tests::find_total;
using tests::VehicleFixture;

namespace {

/// Distance is the trace's, audits close, and what the hubs gave is what was lost.
void check_city(const VehicleFixture& fixture, bool multibody) {
  const auto recording = multibody ? fixture.run_multibody_rosenbrock(city()) : fixture.run_quasi_static(city());
  const auto layout = fixture.layout();
  INFO(fixture.rig.name << ", wheels " << layout.wheels.size() << ", " << (multibody ? "multibody" : "quasi-static"));
  CHECK_NOTHROW(recording.audit.require_closed(scenarios::kDriveAuditLimit));
  CHECK(find_total(recording, VehicleIntegral::kDistance) == Approx(11989.8).margin(2.0));  // 7.45 miles
  double loss_J = 0.0;
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    loss_J += recording.final_integrals[rigs::index_of(rigs::WheelIntegral::kRollingEnergy, i)];
  }
  CHECK(find_total(recording, VehicleIntegral::kTireLoss) == Approx(loss_J).epsilon(1e-4));
  CHECK(find_total(recording, VehicleIntegral::kHeatGenerated) == Approx(loss_J).epsilon(1e-4));
  const double recuperated_J = find_total(recording, VehicleIntegral::kRecuperated);
  CHECK(recuperated_J > 0.2 * find_total(recording, VehicleIntegral::kDriveEnergy));
  CHECK(recuperated_J < find_total(recording, VehicleIntegral::kDriveEnergy));
}

}  // namespace

TEST_CASE("on the city cycle a quarter's energy closes to 1e-5", "[slow]") {
  for (const bool multibody : {false, true}) {
    check_city(VehicleFixture("dyno_1m2", false, tests::kFront), multibody);
    check_city(VehicleFixture("road", false, tests::kRear), multibody);
  }
}

TEST_CASE("and a whole vehicle's", "[slow]") {
  for (const char* rig : {"dyno_1m2", "road"}) {
    for (const bool multibody : {false, true}) check_city(VehicleFixture(rig, true), multibody);
  }
}

TEST_CASE("the city cycle's energies hold at ten times tighter tolerances, and at half the steps", "[slow]") {
  for (const char* rig : {"dyno_1m2", "road"}) {
    VehicleFixture fixture(rig);
    const auto usual = fixture.run_multibody(city());
    fixture.cvodes.tolerance_factor = 0.1;
    const auto tight = fixture.run_multibody(city());
    const auto rosenbrock = fixture.run_multibody_rosenbrock(city());
    CHECK_NOTHROW(rosenbrock.audit.require_closed(scenarios::kDriveAuditLimit));
    const auto coarse = fixture.run_quasi_static(city());
    sim::Program halved = city();
    for (sim::Segment& segment : halved.phases[0].segments) segment.max_step_s = 0.5;
    const auto fine = fixture.run_quasi_static(halved);
    for (const auto integral : {VehicleIntegral::kDriveEnergy, VehicleIntegral::kRecuperated,
                                VehicleIntegral::kBrakeLoss, VehicleIntegral::kTireLoss, VehicleIntegral::kDistance}) {
      INFO(rig << ", integral " << rigs::index_of(integral));
      // Friction brakes do a small part, in the knee below 10 km/h: they are judged by what the cycle moves.
      const bool small = integral == VehicleIntegral::kBrakeLoss;
      const double scale = find_total(tight, small ? VehicleIntegral::kDriveEnergy : integral);
      CHECK(find_total(usual, integral) == Approx(find_total(tight, integral)).margin(1e-5 * scale));
      CHECK(find_total(rosenbrock, integral) == Approx(find_total(tight, integral)).margin(1e-5 * scale));
      CHECK(find_total(coarse, integral) == Approx(find_total(fine, integral)).margin(1e-4 * scale));
    }
  }
}
