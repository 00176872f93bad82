// A vehicle that stands, starts and brakes, on rollers and on the road, in both fidelities.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/rigs/vehicles_on.h"

using namespace rollrig;
using rigs::VehicleIntegral;
using tests::all_on;
using tests::driving;
using tests::find_total;
using tests::make_program;
using tests::name_of;
using tests::VehicleFixture;

TEST_CASE("standing with the driver's foot on the brake is standing, on a hill as well", "[fast]") {
  for (const double slope : {0.0, 0.06, -0.06}) {
    for (const std::string rig : {"road", "dyno_1m2"}) {
      if (slope != 0.0 && rig != "road") continue;
      for (const VehicleFixture& fixture : all_on(rig)) {
        for (const bool multibody : {false, true}) {
          const auto recording = fixture.run(multibody, make_program({driving("stand", 600.0, 0.0, 0.0, slope)}));
          INFO(rig << ", " << name_of(multibody) << ", slope " << slope << ", wheels "
                   << fixture.layout().wheels.size());
          CHECK(std::abs(find_total(recording, VehicleIntegral::kDistance)) < 0.05);
          CHECK(std::abs(find_total(recording, VehicleIntegral::kTireLoss)) < 5.0);
          CHECK(
              recording.channel(rigs::wheel_channel(models::quantities::kLinerTemperature, fixture.layout().wheels[0]))
                  .back() == Approx(293.15).margin(1e-3));
        }
      }
    }
  }
}

TEST_CASE("start, a short drive and a stop, again and again, on a hill as well", "[slow]") {
  for (const double slope : {0.0, 0.06, -0.06}) {
    for (const std::string rig : {"road", "dyno_1m2"}) {
      if (slope != 0.0 && rig != "road") continue;
      for (VehicleFixture fixture : all_on(rig)) {
        tests::set_front_load(fixture.vehicle,
                              0.5);  // held on a hill, uneven axles take the integrator 60 times as long
        std::vector<sim::Phase> phases;
        for (int stop = 0; stop < 3; ++stop) {
          phases.push_back(driving("stand", 60.0, 0.0, 0.0, slope));
          phases.push_back(driving("start", 5.0, 0.0, 10.0, slope));
          phases.push_back(driving("drive", 10.0, 10.0, 10.0, slope));
          phases.push_back(driving("brake", 3.0, 10.0, 0.0, slope));
        }
        phases.push_back(driving("stand", 60.0, 0.0, 0.0, slope));
        for (const bool multibody : {false, true}) {
          INFO(rig << ", " << name_of(multibody) << ", slope " << slope << ", wheels "
                   << fixture.layout().wheels.size());
          sim::Recording<double> recording;
          REQUIRE_NOTHROW(recording = fixture.run(multibody, make_program(phases)));
          // three times 25 m, 100 m, 15 m
          CHECK(find_total(recording, VehicleIntegral::kDistance) == Approx(420.0).margin(0.5));
          CHECK_NOTHROW(recording.audit.require_closed(1e-5));
        }
      }
    }
  }
}

TEST_CASE("braking to a stop: the motor takes its share, friction the rest, nothing is lost", "[fast]") {
  // Lossless vehicle from v0 at 3 m/s2, motor's limit L, fading below v_f: it takes
  // L/a ((v0^2 - v_f^2)/2 + v_f^2/3)
  constexpr double kStart_m_s = 20.0, kDeceleration_m_s2 = 3.0, kFade_m_s = 10.0 / 3.6;
  for (VehicleFixture fixture : all_on("dyno_1m2")) {
    fixture.take_losses_away();
    const auto layout = fixture.layout();
    const double mass_kg = layout.mass_kg + layout.rotating_mass_kg;
    const double limit_N = layout.mass_kg * 1.5;
    const double motor_J = limit_N / kDeceleration_m_s2 *
                           ((kStart_m_s * kStart_m_s - kFade_m_s * kFade_m_s) / 2.0 + kFade_m_s * kFade_m_s / 3.0);
    for (const bool multibody : {false, true}) {
      const auto recording =
          fixture.run(multibody, make_program({driving("hold", 10.0, kStart_m_s, kStart_m_s),
                                               driving("brake", kStart_m_s / kDeceleration_m_s2, kStart_m_s, 0.0),
                                               driving("stand", 30.0, 0.0, 0.0)}));
      INFO(name_of(multibody) << ", wheels " << layout.wheels.size());
      // The multibody contact, stiff as it is, takes Fx^2/C, and its driver a moment at each knot.
      CHECK(find_total(recording, VehicleIntegral::kRecuperated) == Approx(motor_J).epsilon(multibody ? 2e-3 : 1e-4));
      const double distance_m = 200.0 + kStart_m_s * kStart_m_s / (2.0 * kDeceleration_m_s2);
      CHECK(find_total(recording, VehicleIntegral::kDistance) == Approx(distance_m).epsilon(1e-4));
      // Kinetic energy of what the whole of it moves comes out of hubs, brakes and the rest of the vehicle.
      const double into_hubs_J = -recording.audit.find_term_J(sim::kMotorWork);
      const double brakes_J = find_total(recording, VehicleIntegral::kBrakeLoss);
      const double rest_J =
          -find_total(recording, VehicleIntegral::kRollerWork) - find_total(recording, VehicleIntegral::kKnotWork);
      CHECK(into_hubs_J + brakes_J + rest_J == Approx(0.5 * mass_kg * kStart_m_s * kStart_m_s).epsilon(5e-4));
      CHECK(brakes_J >= 0.0);
    }
  }
}

TEST_CASE("the brakes' work is shared by the axles as the file says", "[fast]") {
  VehicleFixture front("dyno_1m2", false, tests::kFront);
  VehicleFixture rear("dyno_1m2", false, tests::kRear);
  for (const bool multibody : {false, true}) {
    const auto program = make_program({driving("brake", 5.0, 20.0, 0.0), driving("stand", 5.0, 0.0, 0.0)});
    const double front_J = find_total(front.run(multibody, program), VehicleIntegral::kBrakeLoss);
    const double rear_J = find_total(rear.run(multibody, program), VehicleIntegral::kBrakeLoss);
    INFO(name_of(multibody));
    CHECK(front_J / (front_J + rear_J) == Approx(0.68).epsilon(1e-3));
  }
}
