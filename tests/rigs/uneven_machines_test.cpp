// A drum that is not of 2 m and a vehicle whose axles differ: radius, inertia and shares have to be the right ones.
#include <catch2/catch.hpp>

#include "tests/support/machines.h"
#include "tests/support/uneven_machines.h"
#include "tests/support/vehicle_fixture.h"

using namespace rollrig;
using rigs::VehicleIntegral;
using tests::DrumFixture;
using tests::find_total;
using tests::make_program;
using tests::VehicleFixture;

namespace {

constexpr double kUnevenSpeed_m_s = 27.0;
constexpr double kLoad_N = 4700.0;
constexpr double kRrc = 0.0083;

DrumFixture make_uneven_fixture() {
  DrumFixture fixture;
  fixture.rig = tests::make_uneven_drum();
  fixture.baseline = models::Baseline::kConstantRrc;
  fixture.tire.has_constant = true;
  fixture.tire.values.constant.rrc = kRrc;
  return fixture;
}

VehicleFixture make_uneven_fixture(const char* rig, bool whole, std::size_t quarter = tests::kRear) {
  VehicleFixture fixture(rig, whole, quarter);
  if (fixture.rig.kind == tests::kDyno) fixture.rig = tests::make_uneven_dyno();
  fixture.vehicle = tests::make_uneven_vehicle();
  fixture.set_load = {110.0, 1.3, 0.41};
  return fixture;
}

/// Forces of a drum that starts with a segment, at its first instant.
rigs::DrumForces find_first_forces(const DrumFixture& fixture, const sim::Segment& segment) {
  models::Corner<double> corner = fixture.corner();
  const auto drum = rigs::make_multibody_drum(corner, fixture.rig, fixture.start(), false);
  std::vector<double> state(drum->state_count());
  drum->initialize(segment, 0.0, state.data());
  drum->begin_segment(segment, 0.0, state.data(), nullptr);
  return drum->find_forces(0.0, state.data());
}

rigs::VehicleForces find_first_forces(const VehicleFixture& fixture, const sim::Phase& phase) {
  std::vector<models::Corner<double>> corners = fixture.corners();
  const auto vehicle = rigs::make_multibody_vehicle(corners, fixture.layout(), fixture.start(), false);
  std::vector<double> state(vehicle->state_count());
  vehicle->initialize(phase.segments.front(), 0.0, state.data());
  return vehicle->find_forces(0.0, state.data());
}

}  // namespace

TEST_CASE("a drum that starts rolling is in equilibrium at its first instant", "[fast]") {
  const DrumFixture fixture = make_uneven_fixture();
  const double radius_m = 0.5 * fixture.rig.drum.diameter_m;
  const rigs::DrumForces at =
      find_first_forces(fixture, tests::drum_segment(60.0, kUnevenSpeed_m_s, kUnevenSpeed_m_s, kLoad_N));
  CHECK(at.contact_load_N == Approx(kLoad_N).epsilon(1e-9));
  CHECK(at.surface_speed_m_s == Approx(kUnevenSpeed_m_s).epsilon(1e-12));
  CHECK(at.wheel_speed_rad_s * at.loaded_radius_m == Approx(kUnevenSpeed_m_s).epsilon(1e-12));
  CHECK(at.drum_speed_rad_s * radius_m == Approx(kUnevenSpeed_m_s).epsilon(1e-12));
  // The motor's power is all that is lost, and nothing else moves the tire.
  CHECK(at.motor_torque_Nm * at.drum_speed_rad_s ==
        Approx((kRrc * kLoad_N + at.parasitic_N) * kUnevenSpeed_m_s).epsilon(1e-9));
  CHECK(at.hub_moment_Nm == Approx(0.0).margin(1e-6));
}

TEST_CASE("a vehicle that starts rolling is in equilibrium at its first instant, on rollers and on the road",
          "[fast]") {
  for (const char* rig : {"dyno_1m2", "road"}) {
    const VehicleFixture fixture = make_uneven_fixture(rig, true);
    const auto layout = fixture.layout();
    const rigs::VehicleForces at =
        find_first_forces(fixture, tests::driving("hold", 60.0, kUnevenSpeed_m_s, kUnevenSpeed_m_s));
    for (std::size_t i = 0; i < at.wheels.size(); ++i) {
      INFO(rig << ", " << layout.wheels[i].position);
      CHECK(at.wheels[i].contact_load_N == Approx(layout.wheels[i].static_load_N).epsilon(1e-9));
      CHECK(at.wheels[i].wheel_speed_rad_s * at.wheels[i].loaded_radius_m == Approx(kUnevenSpeed_m_s).epsilon(1e-9));
      if (fixture.rig.kind == tests::kRoad) continue;
      CHECK(at.wheels[i].roller_speed_rad_s * 0.5 * fixture.rig.drum.diameter_m ==
            Approx(kUnevenSpeed_m_s).epsilon(1e-9));
    }
    CHECK(at.speed_m_s == Approx(kUnevenSpeed_m_s).epsilon(1e-9));
  }
}

TEST_CASE("the drum follows a ramp from its first moment: the motor gives the torque of its inertia at once",
          "[fast]") {
  const DrumFixture fixture = make_uneven_fixture();
  constexpr double kAcceleration_m_s2 = 0.9;
  constexpr double kHold_s = 20.0;
  for (const double ramp_s : {0.1, 0.35, 1.0, 5.0}) {
    const double end_m_s = kUnevenSpeed_m_s + kAcceleration_m_s2 * ramp_s;
    sim::Phase up;
    up.name = "up";
    up.segments = {tests::drum_segment(ramp_s, kUnevenSpeed_m_s, end_m_s, kLoad_N)};
    models::Corner<double> corner = fixture.corner();
    const auto drum = rigs::make_multibody_drum(corner, fixture.rig, fixture.start(), false);
    sim::CvodesIntegrator integrator(*drum, fixture.cvodes);
    const auto recording = sim::simulate<double>(
        *drum, integrator, make_program({tests::rolling("hold", kHold_s, kUnevenSpeed_m_s, kLoad_N), up}));
    INFO("after " << ramp_s << " s");
    // By the controller alone it would lag by up to 0.9/(3 e) = 0.11 m/s.
    const rigs::DrumForces at = drum->find_forces(kHold_s + ramp_s, recording.final_state.data());
    CHECK(at.surface_speed_m_s == Approx(end_m_s).margin(1e-3));
  }
}

TEST_CASE("the weight of an uneven vehicle acts in its center of gravity", "[fast]") {
  for (const char* rig : {"dyno_1m2", "road"}) {
    const VehicleFixture fixture = make_uneven_fixture(rig, true);
    double weight_N = 0.0, moment_Nm = 0.0, front_N = 0.0, motor = 0.0, front_brakes = 0.0, rear_brakes = 0.0;
    double front_x_m = 0.0, rear_x_m = 0.0;
    for (const rigs::WheelPlace& wheel : fixture.layout().wheels) {
      weight_N += wheel.static_load_N;
      moment_Nm += wheel.static_load_N * wheel.axle_x_m;
      const bool is_front = wheel.axle == tests::kFront;
      if (is_front) front_N += wheel.static_load_N;
      (is_front ? front_x_m : rear_x_m) = wheel.axle_x_m;
      (is_front ? front_brakes : rear_brakes) += wheel.friction_share;
      if (!is_front) motor += wheel.motor_share;
    }
    INFO(rig);
    CHECK(weight_N == Approx(fixture.vehicle.body.mass_kg * kStandardGravity_m_s2));
    CHECK(moment_Nm == Approx(0.0).margin(1e-9 * weight_N));
    CHECK(front_x_m - rear_x_m == Approx(2.7));
    CHECK(front_x_m > 0.0);
    CHECK(front_N == Approx(0.56 * weight_N));
    CHECK(front_brakes == Approx(0.68));
    CHECK(rear_brakes == Approx(0.32));
    CHECK(motor == Approx(1.0));
  }
}

TEST_CASE("axles of an uneven vehicle bear and brake what the file says, whatever the size of the rollers", "[fast]") {
  const auto program = make_program({tests::driving("brake", 4.0, 16.0, 0.0), tests::driving("stand", 5.0, 0.0, 0.0)});
  for (const bool multibody : {false, true}) {
    const auto front_fixture = make_uneven_fixture("dyno_1m2", false, tests::kFront);
    const auto rear_fixture = make_uneven_fixture("dyno_1m2", false, tests::kRear);
    const auto front = front_fixture.run(multibody, program);
    const auto rear = rear_fixture.run(multibody, program);
    INFO((multibody ? "multibody" : "quasi-static"));
    const double weight_N = front_fixture.vehicle.body.mass_kg * kStandardGravity_m_s2;
    CHECK(front.channel("contact_load_N").back() == Approx(0.56 * weight_N / 2.0).epsilon(1e-6));
    CHECK(rear.channel("contact_load_N").back() == Approx(0.44 * weight_N / 2.0).epsilon(1e-6));
    const double front_J = find_total(front, VehicleIntegral::kBrakeLoss);
    const double rear_J = find_total(rear, VehicleIntegral::kBrakeLoss);
    CHECK(front_J / (front_J + rear_J) == Approx(0.68).epsilon(2e-3));
  }
}
