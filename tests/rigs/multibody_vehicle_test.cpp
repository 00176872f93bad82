// The vehicle in Simbody, looked into: Newton's laws, and what the closed forms say of its parts.
#include "rigs/multibody_vehicle.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "sim/core/error.h"
#include "tests/support/hand_fed_corner.h"
#include "tests/support/vehicle_fixture.h"

using namespace rollrig;
using rigs::VehicleIntegral;
using tests::coasting;
using tests::driving;
using tests::find_total;
using tests::make_program;
using tests::VehicleFixture;

namespace {

constexpr double kVehicleSpeed_m_s = 80.0 / 3.6;

/// A vehicle that was run through a program and can be looked into at its end.
struct VehicleRun {
  std::vector<models::Corner<double>> corners;
  std::unique_ptr<rigs::MultibodyVehicle> vehicle;
  sim::Recording<double> recording;
  double end_s;

  VehicleRun(const VehicleFixture& fixture, const sim::Program& program)
      : corners(fixture.corners()),
        vehicle(rigs::make_multibody_vehicle(corners, fixture.layout(), fixture.start(), false)) {
    sim::CvodesIntegrator integrator(*vehicle, fixture.cvodes);
    recording = sim::simulate<double>(*vehicle, integrator, program);
    end_s = recording.phases.back().end_s;
  }
  rigs::VehicleForces forces() { return vehicle->find_forces(end_s, recording.final_state.data()); }
};

sim::Program hold(double duration_s = 60.0) {
  return make_program({driving("hold", duration_s, kVehicleSpeed_m_s, kVehicleSpeed_m_s)});
}

VehicleFixture make_uneven(const char* rig, double front_drive) {
  VehicleFixture fixture(rig, true);
  tests::set_front_load(fixture.vehicle, 0.6);
  tests::set_front_drive(fixture.vehicle, front_drive);
  fixture.set_load = {100.0, 2.0, 0.4};
  return fixture;
}

double calc_rolling_mass_kg(const VehicleFixture& fixture) {
  return fixture.tire.values.geometry.mass_kg + fixture.tire.values.geometry.wheel_mass_kg;
}

}  // namespace

TEST_CASE("what the rollers push, the tie-downs hold: the ground's forces sum to nothing", "[fast]") {
  for (const double front_drive : {1.0, 0.0, 0.5}) {
    const VehicleFixture fixture = make_uneven("dyno_1m2", front_drive);
    VehicleRun ran(fixture, hold());
    const rigs::VehicleForces at = ran.forces();
    double rollers_N = 0.0, spindles_N = 0.0, lift_N = 0.0, roller_weight_N = 0.0;
    for (const auto& wheel : at.wheels) {
      rollers_N += wheel.roller_reaction_N;
      spindles_N += wheel.spindle_reaction_N;
      lift_N += wheel.roller_lift_N;
      roller_weight_N += wheel.roller_mass_kg * kStandardGravity_m_s2;
    }
    INFO("front drive share " << front_drive);
    CHECK(std::abs(at.tie_down_N) > 10.0);  // there is something to be held
    CHECK(rollers_N + at.tie_down_N == Approx(0.0).margin(0.02));
    CHECK(spindles_N == Approx(at.tie_down_N).margin(0.02));
    CHECK(lift_N == Approx(fixture.vehicle.body.mass_kg * kStandardGravity_m_s2 + roller_weight_N).epsilon(1e-8));
  }
}

TEST_CASE("tie-downs carry the drive force less what the tires lose on their way to the rollers", "[fast]") {
  // Steady: hub torque T = (X + F_rr/(1 + r_l k)) r_l for each wheel; the tie-downs hold the sum of X, and
  // give way by x, so that the wheels stand off the tops of their rollers and their loads push as well: x/(R +
  // r_l).
  const VehicleFixture fixture = make_uneven("dyno_1m2", 0.0);
  VehicleRun ran(fixture, hold());
  double expected_N = 0.0;
  const double given_way_m = -ran.forces().tie_down_N / fixture.rig.tie_down.stiffness_N_per_m;
  for (const auto& wheel : ran.forces().wheels) {
    const double r_m = wheel.loaded_radius_m;
    const double contact_N = wheel.hub_torque_Nm / r_m - wheel.rolling_resistance_N / (1.0 + r_m / 0.6);
    CHECK(wheel.contact_force_N == Approx(contact_N).margin(1e-3));
    expected_N += contact_N + wheel.contact_load_N * given_way_m / (0.6 + r_m);
  }
  CHECK(ran.forces().tie_down_N == Approx(-expected_N).margin(0.02));
}

TEST_CASE("each wheel rolls with its own loaded radius, each roller at the speed asked for", "[fast]") {
  const VehicleFixture fixture = make_uneven("dyno_1m2", 0.0);
  VehicleRun ran(fixture, hold());
  const auto layout = fixture.layout();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto wheel = ran.forces().wheels[i];
    INFO(layout.wheels[i].position);
    CHECK(wheel.contact_load_N == Approx(layout.wheels[i].static_load_N).epsilon(2e-5));
    CHECK(wheel.loaded_radius_m == Approx(0.7176 / 2.0 - layout.wheels[i].static_load_N / 220000.0).epsilon(2e-5));
    CHECK(wheel.wheel_speed_rad_s * wheel.loaded_radius_m == Approx(kVehicleSpeed_m_s).epsilon(1e-4));
    CHECK(wheel.roller_speed_rad_s * 0.6 == Approx(kVehicleSpeed_m_s).epsilon(1e-5));
  }
}

TEST_CASE("without loss no torque, no slip, no force: at any tolerance", "[fast]") {
  for (const char* rig : {"dyno_1m2", "road"}) {
    for (const double factor : {100.0, 1.0, 1e-2}) {
      VehicleFixture fixture(rig, true);
      tests::set_front_load(fixture.vehicle, 0.5);  // without the rounding of uneven radii
      fixture.take_losses_away();
      fixture.vehicle.body.drag_area_m2 = 0.0;
      fixture.cvodes.tolerance_factor = factor;
      VehicleRun ran(fixture, make_program({driving("hold", 30.0, kVehicleSpeed_m_s, kVehicleSpeed_m_s),
                                            coasting(kVehicleSpeed_m_s, 1.0, 60.0)}));
      INFO(rig << ", tolerances times " << factor);
      const rigs::VehicleForces at = ran.forces();
      // In a contact as stiff as the baseline's, a slip of 1e-7 m/s makes 0.1 N: that is 5e-9 of the speed.
      for (const auto& wheel : at.wheels) CHECK(std::abs(wheel.contact_force_N) < 0.05 * std::max(1.0, factor));
      CHECK(std::abs(at.tie_down_N) < 1e-3 * factor);
      CHECK(at.speed_m_s == Approx(kVehicleSpeed_m_s).epsilon(1e-7));
    }
  }
}

TEST_CASE("on the road the spindles push the body, which the road pushes through the wheels", "[fast]") {
  // Coasting: the body's own deceleration times its mass is drag and what the spindles hold back.
  VehicleFixture fixture("road", true);
  VehicleRun ran(fixture, make_program({coasting(35.0, 30.0)}));
  const rigs::VehicleForces at = ran.forces();
  double contact_N = 0.0, loss_N = 0.0, rolling_N = 0.0;
  for (const auto& wheel : at.wheels) {
    contact_N += wheel.contact_force_N;
    loss_N += wheel.rolling_resistance_N;
    rolling_N += wheel.hub_torque_Nm;
  }
  const double density_kg_per_m3 = 98210.0 / (287.05 * 293.15);
  const double drag_N = 0.5 * density_kg_per_m3 * 0.72 * at.speed_m_s * at.speed_m_s;
  const double deceleration_m_s2 = (loss_N + drag_N) / fixture.total_mass_kg();
  CHECK(rolling_N == 0.0);
  double spin_kg = 0.0;
  for (const auto& wheel : at.wheels) {
    spin_kg += fixture.tire.values.geometry.spin_inertia_kg_m2 / (wheel.loaded_radius_m * wheel.loaded_radius_m);
  }
  // each wheel is slowed by its loss and helped on by its own turning
  CHECK(contact_N == Approx(-loss_N + spin_kg * deceleration_m_s2).epsilon(1e-3));
}

TEST_CASE("accelerating on the road shifts load from the front to the rear by the moment of all inertia", "[fast]") {
  // About a point of the road: sum over masses of m h a, and the wheels' spin I a/r, over the wheelbase.
  // Stiff suspension, so that the axles do not swing forwards under a squatting body.
  VehicleFixture fixture("road", true);
  for (rigs::VehicleAxle& axle : fixture.vehicle.axles) {
    axle.suspension.stiffness_N_per_m = 3e5;
    axle.suspension.damping_N_s_per_m = 2e4;
  }
  constexpr double kAcceleration_m_s2 = 1.0;
  const auto program = make_program({driving("hold", 5.0, 10.0, 10.0), driving("faster", 15.0, 10.0, 25.0)});
  VehicleRun ran(fixture, program);
  const auto at = ran.forces();
  const double radius_m = at.wheels[0].loaded_radius_m;
  const double unsprung_kg =
      4.0 * (fixture.vehicle.axles.front().suspension.unsprung_mass_kg + calc_rolling_mass_kg(fixture));
  const double height_m = fixture.vehicle.center_of_gravity_height_m;
  const double spin_kg = 4.0 * fixture.tire.values.geometry.spin_inertia_kg_m2 / (radius_m * radius_m);
  const double drag_N = 0.5 * 98210.0 / (287.05 * 293.15) * 0.72 * 25.0 * 25.0;
  const double moment_Nm = kAcceleration_m_s2 * ((fixture.total_mass_kg() - unsprung_kg - spin_kg) * height_m +
                                                 unsprung_kg * radius_m + spin_kg * radius_m) +
                           drag_N * height_m;
  double couples_Nm = 0.0;  // rolling resistance: the normal force stands before the axle
  for (const auto& wheel : at.wheels) couples_Nm += wheel.rolling_resistance_N * wheel.loaded_radius_m;
  const double shifted_N = (moment_Nm + couples_Nm) / fixture.vehicle.axles.back().position_m;
  const double front_N = at.wheels[0].contact_load_N + at.wheels[1].contact_load_N;
  const double rear_N = at.wheels[2].contact_load_N + at.wheels[3].contact_load_N;
  const double weight_N = fixture.vehicle.body.mass_kg * kStandardGravity_m_s2;
  CHECK(rear_N - fixture.vehicle.axles.back().load_share * weight_N == Approx(shifted_N).epsilon(0.01));
  CHECK(front_N + rear_N == Approx(weight_N).epsilon(1e-4));
}

TEST_CASE("the two sides of the vehicle are alike", "[fast]") {
  const VehicleFixture fixture = make_uneven("dyno_1m2", 1.0);
  const auto recording =
      fixture.run_multibody(make_program({driving("faster", 10.0, 5.0, 20.0), driving("brake", 5.0, 20.0, 5.0)}));
  for (const char* channel : {"loss_force", "contact_load", "longitudinal_force"}) {
    for (const char* axle : {"front", "rear"}) {
      const auto& left = recording.channel(std::string(channel) + "_" + axle + "_left_N");
      const auto& right = recording.channel(std::string(channel) + "_" + axle + "_right_N");
      for (std::size_t i = 0; i < left.size(); ++i) CHECK(left[i] == Approx(right[i]).epsilon(1e-6).margin(1e-3));
    }
  }
}

TEST_CASE("sections' energies hold at tighter tolerances", "[fast]") {
  const auto program = make_program({driving("stand", 20.0, 0.0, 0.0), driving("speed up", 12.0, 0.0, 18.0),
                                     driving("hold", 30.0, 18.0, 18.0), driving("slow down", 9.0, 18.0, 0.0),
                                     driving("stand", 10.0, 0.0, 0.0), driving("speed up", 8.0, 0.0, 12.0),
                                     driving("brake", 4.0, 12.0, 0.0), driving("stand", 10.0, 0.0, 0.0)});
  for (const char* rig : {"dyno_1m2", "road"}) {
    VehicleFixture fixture(rig);
    const auto usual = fixture.run_multibody(program);
    fixture.cvodes.tolerance_factor = 0.1;
    const auto tight = fixture.run_multibody(program);
    INFO(rig);
    for (const auto integral : {VehicleIntegral::kDriveEnergy, VehicleIntegral::kRecuperated,
                                VehicleIntegral::kBrakeLoss, VehicleIntegral::kTireLoss}) {
      INFO(rigs::index_of(integral));
      CHECK(find_total(usual, integral) == Approx(find_total(tight, integral)).epsilon(2e-5));
    }
  }
}

TEST_CASE("two vehicles at once do not disturb each other", "[fast]") {
  const VehicleFixture on_rollers("dyno_1m2", true);
  const VehicleFixture on_road("road", true);
  const double alone_N = on_rollers.run_multibody(hold(10.0)).channel("loss_force_front_left_N").back();
  VehicleRun first(on_rollers, hold(10.0));
  VehicleRun second(on_road, hold(10.0));
  CHECK(first.recording.channel("loss_force_front_left_N").back() == alone_N);
  CHECK(first.forces().wheels[0].roller_speed_rad_s > 0.0);
  CHECK(second.forces().wheels[0].roller_speed_rad_s == 0.0);
}

TEST_CASE("a driver who cannot keep the speed is a failed run, not a result", "[fast]") {
  // From standstill to 30 m/s at once: a step that no motor follows.
  const VehicleFixture fixture("dyno_1m2");
  CHECK_THROWS_WITH(
      fixture.run_multibody(make_program({driving("stand", 5.0, 0.0, 0.0), driving("at once", 20.0, 30.0, 30.0)})),
      Catch::Contains("does not keep the speed"));
}

TEST_CASE("the temperatures of every wheel are asked whether they are possible, in both fidelities", "[fast]") {
  const auto check_each = [](const sim::OdeSystem<double>& vehicle, const std::vector<double>& state,
                             std::size_t wheels) {
    CHECK_NOTHROW(vehicle.require_possible(state.data()));
    std::size_t temperatures = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      if (state[i] < 280.0 || state[i] > 360.0) continue;  // no other state of a vehicle that stands is so large
      ++temperatures;
      std::vector<double> hot = state;
      hot[i] = 2000.0;
      CHECK_THROWS_AS(vehicle.require_possible(hot.data()), RunFailure);
    }
    CHECK(temperatures == 2 * wheels);  // rubber and gas
  };
  const VehicleFixture fixture("dyno_1m2", true);
  const sim::Program stand = make_program({driving("stand", 5.0, 0.0, 0.0)});
  VehicleRun ran(fixture, stand);
  check_each(*ran.vehicle, ran.recording.final_state, ran.corners.size());
  std::vector<models::Corner<double>> corners = fixture.corners();
  const rigs::QuasiStaticVehicle<double> quasi_static(corners, fixture.layout(), fixture.start(), false);
  check_each(quasi_static, fixture.run_quasi_static(stand).final_state, corners.size());
}
