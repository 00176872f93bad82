// Vehicles of any axles: a tractor on three of them, and cars whose axles have tires of their own.
#include <catch2/catch.hpp>

#include "build_paths.h"
#include "scenarios/common/vehicle_bench.h"
#include "sim/core/assets.h"
#include "tests/rigs/vehicles_on.h"

using namespace rollrig;
using rigs::VehicleIntegral;
using rigs::WheelIntegral;
using tests::city;
using tests::coasting;
using tests::driving;
using tests::find_total;
using tests::kFront;
using tests::kRear;
using tests::make_program;
using tests::name_of;
using tests::VehicleFixture;

namespace {

VehicleFixture make_tractor(const char* rig) {
  VehicleFixture fixture(rig, true);
  fixture.vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "tractor_6x4")));
  fixture.tire = models::read_tire(read_config(std::string(ROLLRIG_SOURCE_DIR) + "/tests/support/truck_tire.toml"));
  fixture.set_load = {300.0, 5.0, 3.0};
  return fixture;
}

/// A car whose axles differ in load, drive, brakes and tires: a40 in front, a60 behind.
VehicleFixture make_mixed_car(const char* rig) {
  VehicleFixture fixture(rig, true);
  tests::set_front_load(fixture.vehicle, 0.57);
  tests::set_front_drive(fixture.vehicle, 0.3);
  fixture.vehicle.axles[kFront].tire = tests::read_combined_tire("a40");
  fixture.vehicle.axles[kRear].tire = tests::read_combined_tire("a60");
  fixture.vehicle.axles[kRear].pressure_Pa = 310e3;
  return fixture;
}

sim::Program short_drive() {
  return make_program({driving("stand", 5.0, 0.0, 0.0), driving("speed up", 15.0, 0.0, 25.0),
                       driving("hold", 200.0, 25.0, 25.0), driving("slow down", 10.0, 25.0, 8.0),
                       driving("stop", 4.0, 8.0, 0.0), driving("stand again", 10.0, 0.0, 0.0)});
}

double of_wheel(const sim::Recording<double>& recording, WheelIntegral integral, std::size_t wheel) {
  return recording.final_integrals[rigs::index_of(integral, wheel)];
}

}  // namespace

TEST_CASE("six wheels of a tractor bear its weight in its center of gravity, four of them drive", "[fast]") {
  const VehicleFixture fixture = make_tractor("road");
  const rigs::VehicleLayout layout = fixture.layout();
  REQUIRE(layout.wheels.size() == 6);
  CHECK(layout.wheels[3].position == "drive_1_right");
  double weight_N = 0.0, moment_Nm = 0.0, brakes = 0.0;
  for (const rigs::WheelPlace& wheel : layout.wheels) {
    weight_N += wheel.static_load_N;
    moment_Nm += wheel.static_load_N * wheel.axle_x_m;
    brakes += wheel.friction_share;
    CHECK(wheel.motor_share == (wheel.axle == 0 ? 0.0 : 0.25));
  }
  CHECK(weight_N == Approx(18500.0 * kStandardGravity_m_s2));
  CHECK(moment_Nm == Approx(0.0).margin(1e-9 * weight_N));
  CHECK(brakes == Approx(1.0));
  CHECK(layout.wheels[0].axle_x_m - layout.wheels[5].axle_x_m == Approx(4.65));
}

TEST_CASE("a tractor's wheels bear at rest what its axles' shares say, though three axles could share otherwise",
          "[fast]") {
  for (const char* rig : {"dyno_48in", "road"}) {
    const VehicleFixture fixture = make_tractor(rig);
    const auto recording = fixture.run_multibody(make_program({driving("stand", 20.0, 0.0, 0.0)}));
    for (const rigs::WheelPlace& wheel : fixture.layout().wheels) {
      INFO(rig << ", " << wheel.position);
      CHECK(recording.channel(rigs::wheel_channel(models::quantities::kContactLoad, wheel)).back() ==
            Approx(wheel.static_load_N).epsilon(1e-6));
    }
  }
}

TEST_CASE("rollers under a tractor's driven axles leave its front axle standing", "[fast]") {
  const VehicleFixture fixture = make_tractor("dyno_48in_2wd");
  const rigs::VehicleLayout layout = fixture.layout();
  REQUIRE(layout.wheels.size() == 4);
  double brakes = 0.0, load_N = 0.0;
  for (const rigs::WheelPlace& wheel : layout.wheels) {
    CHECK(wheel.axle > 0);
    brakes += wheel.friction_share;
    load_N += wheel.static_load_N;
  }
  CHECK(brakes == Approx(1.0));
  CHECK(load_N == Approx(0.64 * 18500.0 * kStandardGravity_m_s2));
  CHECK(layout.wheels[0].friction_share / layout.wheels[2].friction_share == Approx(0.31 / 0.29));
}

TEST_CASE("a tractor coasts down alike in both fidelities, on the road and on rollers, and its energy closes",
          "[fast]") {
  for (const char* rig : {"road", "dyno_48in_2wd"}) {
    const VehicleFixture fixture = make_tractor(rig);
    double end_s[2] = {0.0, 0.0};
    for (const bool multibody : {false, true}) {
      const auto recording = fixture.run(multibody, make_program({coasting(22.0, 5.0)}));
      INFO(rig << ", " << name_of(multibody));
      CHECK_NOTHROW(recording.audit.require_closed(scenarios::kDriveAuditLimit));
      end_s[multibody ? 1 : 0] = recording.phases[0].end_s;
    }
    CHECK(end_s[0] > 100.0);
    CHECK(end_s[1] == Approx(end_s[0]).epsilon(5e-4));
  }
}

TEST_CASE("a tractor drives the city cycle on its driven axles' rollers and on the road, and energies close and agree",
          "[slow]") {
  for (const char* rig : {"road", "dyno_48in_2wd"}) {
    const VehicleFixture fixture = make_tractor(rig);
    std::vector<sim::Recording<double>> runs;
    for (const bool multibody : {false, true}) {
      runs.push_back(fixture.run(multibody, city()));
      INFO(rig << ", " << name_of(multibody));
      CHECK_NOTHROW(runs.back().audit.require_closed(scenarios::kDriveAuditLimit));
      CHECK(find_total(runs.back(), VehicleIntegral::kDistance) == Approx(11989.8).margin(2.0));
    }
    INFO(rig);
    // On the road a body that pitches lets the driver's demand swing across what the motor may brake.
    const double share = std::string(rig) == "road" ? 2e-3 : 5e-4;
    const double drive_J = find_total(runs[0], VehicleIntegral::kDriveEnergy);
    for (const auto integral : {VehicleIntegral::kDriveEnergy, VehicleIntegral::kRecuperated}) {
      CHECK(find_total(runs[1], integral) == Approx(find_total(runs[0], integral)).margin(share * drive_J));
    }
    CHECK(find_total(runs[1], VehicleIntegral::kTireLoss) ==
          Approx(find_total(runs[0], VehicleIntegral::kTireLoss)).epsilon(5e-4));
  }
}

TEST_CASE("each axle of a car with two kinds of tires loses and warms as that of a car with its kind throughout",
          "[fast]") {
  // On rollers the body does not pitch, so that no wheel feels what the others do.
  VehicleFixture mixed = make_mixed_car("dyno_1m2");
  for (const bool multibody : {false, true}) {
    const auto recording = mixed.run(multibody, short_drive());
    const auto layout = mixed.layout();
    CHECK_NOTHROW(recording.audit.require_closed(scenarios::kDriveAuditLimit));
    for (const std::size_t axle : {kFront, kRear}) {
      VehicleFixture alike = mixed;
      for (rigs::VehicleAxle& other : alike.vehicle.axles) {
        other.tire = mixed.vehicle.axles[axle].tire;
        other.pressure_Pa = mixed.vehicle.axles[axle].pressure_Pa;
      }
      const auto of_alike = alike.run(multibody, short_drive());
      for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
        if (layout.wheels[i].axle != axle) continue;
        INFO(name_of(multibody) << ", " << layout.wheels[i].position);
        // A driver takes a moment to find the force that a car asks for, and drives a little less far until then.
        const double limit = multibody ? 5e-5 : 1e-12;
        CHECK(of_wheel(recording, WheelIntegral::kRollingEnergy, i) ==
              Approx(of_wheel(of_alike, WheelIntegral::kRollingEnergy, i)).epsilon(limit));
        for (const Quantity& quantity : {models::quantities::kLinerTemperature, models::quantities::kCavityPressure}) {
          const Quantity channel = rigs::wheel_channel(quantity, layout.wheels[i]);
          CHECK(recording.channel(channel).back() == Approx(of_alike.channel(channel).back()).epsilon(limit));
        }
      }
    }
    // The two kinds do differ.
    CHECK(of_wheel(recording, WheelIntegral::kRollingEnergy, 0) / layout.wheels[0].static_load_N >
          1.02 * of_wheel(recording, WheelIntegral::kRollingEnergy, 2) / layout.wheels[2].static_load_N);
  }
}

TEST_CASE("exchanging a car's axles exchanges what they do", "[fast]") {
  VehicleFixture one = make_mixed_car("dyno_1m2");
  VehicleFixture other = one;
  std::swap(other.vehicle.axles[kFront], other.vehicle.axles[kRear]);
  std::swap(other.vehicle.axles[kFront].name, other.vehicle.axles[kRear].name);
  std::swap(other.vehicle.axles[kFront].position_m, other.vehicle.axles[kRear].position_m);
  for (const bool multibody : {false, true}) {
    const auto at_one = one.run(multibody, short_drive());
    const auto at_other = other.run(multibody, short_drive());
    INFO(name_of(multibody));
    for (const auto integral : {WheelIntegral::kRollingEnergy, WheelIntegral::kLongitudinalForce}) {
      for (const std::size_t wheel : {0u, 2u}) {
        const double there = of_wheel(at_other, integral, 2 - wheel);
        CHECK(of_wheel(at_one, integral, wheel) == Approx(there).epsilon(multibody ? 1e-5 : 1e-12));
        CHECK(of_wheel(at_one, integral, wheel) != Approx(of_wheel(at_other, integral, wheel)).epsilon(0.02));
      }
    }
  }
}

TEST_CASE("motors and brakes of axles do the shares that the file says", "[fast]") {
  // Drive 0.3 and 0.7, brakes 0.68 and 0.32, loads 0.57 and 0.43: no two are alike, in any order.
  const VehicleFixture fixture = make_mixed_car("dyno_1m2");
  const auto program = make_program(
      {driving("hold", 60.0, 25.0, 25.0), driving("brake", 5.0, 25.0, 0.0), driving("stand", 10.0, 0.0, 0.0)});
  for (const bool multibody : {false, true}) {
    VehicleFixture with_motor = fixture;
    with_motor.set_load = {400.0, 0.0, 0.5};
    const auto driven = with_motor.run(multibody, program);
    const auto force_N = [&](const char* wheel) {
      return driven.channel(rigs::wheel_channel(models::quantities::kLongitudinalForce, wheel))[40];
    };
    INFO(name_of(multibody));
    CHECK(force_N("front_left") > 50.0);
    CHECK(force_N("front_left") / force_N("rear_left") == Approx(0.3 / 0.7).epsilon(1e-4));
    VehicleFixture without_motor = fixture;
    without_motor.vehicle.powertrain.regeneration_limit_m_s2 = 0.0;
    const auto braked = without_motor.run(multibody, program);
    const auto brake_N = [&](const char* wheel) {
      return braked.channel(rigs::wheel_channel(models::quantities::kLongitudinalForce, wheel))[62];
    };
    CHECK(brake_N("front_left") < -1000.0);
    CHECK(brake_N("front_left") / brake_N("rear_left") == Approx(0.68 / 0.32).epsilon(1e-3));
    CHECK(driven.channel("load_front_left_N").back() / driven.channel("load_rear_left_N").back() ==
          Approx(0.57 / 0.43));
  }
}

TEST_CASE("straps press every contact by their force, however the axles are sprung", "[fast]") {
  VehicleFixture fixture = make_mixed_car("dyno_1m2");
  fixture.vehicle.axles[kFront].suspension.stiffness_N_per_m = 27000.0;
  fixture.vehicle.axles[kRear].suspension.stiffness_N_per_m = 61000.0;
  fixture.vehicle.axles[kFront].tire->values.stiffness.vertical_N_per_m = 170000.0;
  fixture.effects = {tests::make_active(models::find_effect("tie_down_load"), {250.0, 0.0})};
  const auto recording = fixture.run_multibody(make_program({driving("hold", 20.0, 20.0, 20.0)}));
  for (const rigs::WheelPlace& wheel : fixture.layout().wheels) {
    INFO(wheel.position);
    CHECK(recording.channel(rigs::wheel_channel(models::quantities::kContactLoad, wheel)).back() ==
          Approx(wheel.static_load_N + 250.0).epsilon(1e-6));
  }
}

TEST_CASE("dual tires carry as much as the single ones that they stand for, and a wheel in the middle as well",
          "[fast]") {
  VehicleFixture fixture = make_tractor("road");
  fixture.vehicle.axles[1].wheels = 4;
  fixture.vehicle.axles[2].wheels = 1;
  for (rigs::VehicleAxle& axle : fixture.vehicle.axles) axle.suspension.unsprung_mass_kg = 60.0;
  const auto layout = fixture.layout();
  REQUIRE(layout.wheels.size() == 7);
  CHECK(layout.wheels[6].position == "drive_2");
  for (const bool multibody : {false, true}) {
    const auto recording = fixture.run(multibody, short_drive());
    INFO(name_of(multibody));
    CHECK_NOTHROW(recording.audit.require_closed(scenarios::kDriveAuditLimit));
    CHECK(recording.channel("load_drive_1_left_inner_N").back() ==
          Approx(0.33 * 18500.0 * kStandardGravity_m_s2 / 4.0));
    CHECK(recording.channel("contact_load_drive_2_N").back() ==
          Approx(0.31 * 18500.0 * kStandardGravity_m_s2).epsilon(0.02));
  }
}
