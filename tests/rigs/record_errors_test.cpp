// A rig whose record is wrong is a rig on which the right record would have other numbers: runs with an error of the
// record against runs without one at the values that really act, in both fidelities.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hand_fed_corner.h"
#include "tests/support/vehicle_fixture.h"

using namespace rollrig;
using tests::driving;
using tests::DrumFixture;
using tests::make_program;
using tests::switch_on;
using tests::VehicleFixture;

namespace {

sim::Recording<double> run_drum(bool multibody, const std::vector<models::ActiveEffect>& effects,
                                const sim::Program& program) {
  DrumFixture fixture;
  fixture.effects = effects;
  return multibody ? fixture.run_multibody(program) : fixture.run_quasi_static(program);
}

/// A ramp, two loads and a ramp down, with speed and load times these factors.
sim::Program recorded_drum_program(double speed_factor, double load_factor, double ambient_K = 298.15) {
  const auto phase = [&](const char* name, double duration_s, double from_m_s, double to_m_s, double load_N) {
    sim::Phase made = tests::rolling(name, duration_s, to_m_s * speed_factor, load_N * load_factor);
    made.segments = {tests::drum_segment(duration_s, from_m_s * speed_factor, to_m_s * speed_factor,
                                         load_N * load_factor, ambient_K)};
    return made;
  };
  sim::Program program;
  program.phases = {phase("up", 60.0, 5.0, 25.0, 5000.0), phase("fast", 300.0, 25.0, 25.0, 5000.0),
                    phase("skim", 60.0, 25.0, 25.0, 200.0), phase("down", 60.0, 25.0, 10.0, 4000.0)};
  return program;
}

constexpr const char* kDrumChannels[]{"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"};

void check_same(const sim::Recording<double>& a, const sim::Recording<double>& b, const std::string& channel,
                double tolerance) {
  const auto& of_a = a.channel(channel);
  const auto& of_b = b.channel(channel);
  REQUIRE(of_a.size() == of_b.size());
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (std::isnan(of_a[i]) && std::isnan(of_b[i])) continue;
    worst = std::max(worst, std::abs(of_a[i] - of_b[i]));
    largest = std::max(largest, std::abs(of_b[i]));
  }
  INFO(channel);
  CHECK(worst < tolerance * largest);
}

double tolerance_of(bool multibody) { return multibody ? 1e-5 : 1e-12; }

}  // namespace

TEST_CASE("a drum whose speed record is 4 % low shows what one shows that turns 4 % faster", "[fast]") {
  for (const bool multibody : {false, true}) {
    const auto wrong = run_drum(multibody, {switch_on("speed_record", {4.0})}, recorded_drum_program(1.0, 1.0));
    const auto right = run_drum(multibody, {}, recorded_drum_program(1.04, 1.0));
    for (const char* channel : kDrumChannels) check_same(wrong, right, channel, tolerance_of(multibody));
    for (std::size_t i = 0; i < wrong.row_count(); ++i) {
      CHECK(right.channel("speed_km_h")[i] == Approx(1.04 * wrong.channel("speed_km_h")[i]));
    }
    CHECK_NOTHROW(wrong.audit.require_closed(sim::kAuditLimit));
  }
}

TEST_CASE("a drum whose load record is 5 % high shows what one shows with 5 % less load", "[fast]") {
  for (const bool multibody : {false, true}) {
    const auto wrong = run_drum(multibody, {switch_on("load_record", {-5.0, 0.0})}, recorded_drum_program(1.0, 1.0));
    const auto right = run_drum(multibody, {}, recorded_drum_program(1.0, 0.95));
    for (const char* channel : kDrumChannels) check_same(wrong, right, channel, tolerance_of(multibody));
    CHECK(wrong.channel("load_N").front() == Approx(5000.0));
    CHECK(wrong.channel("contact_load_N")[200] == Approx(4750.0).epsilon(1e-6));
    CHECK_NOTHROW(wrong.audit.require_closed(sim::kAuditLimit));
  }
}

TEST_CASE("a load record whose offset takes all of the skim load lets the tire leave the drum, audits closed",
          "[fast]") {
  for (const bool multibody : {false, true}) {
    const auto lifted = run_drum(multibody, {switch_on("load_record", {-5.0, 1.0})}, recorded_drum_program(1.0, 1.0));
    CHECK(lifted.channel("contact_load_N")[410] < 5.0);
    CHECK(lifted.channel("contact_load_N")[410] >= 0.0);
    CHECK_NOTHROW(lifted.audit.require_closed(sim::kAuditLimit));
  }
}

TEST_CASE("air that is warm at once is a warmer cell, on the drum in both fidelities", "[fast]") {
  for (const bool multibody : {false, true}) {
    const auto wrong =
        run_drum(multibody, {switch_on("cell_air_warming", {5.0, 0.5, 0.0, 0.0})}, recorded_drum_program(1.0, 1.0));
    const auto right = run_drum(multibody, {}, recorded_drum_program(1.0, 1.0, 303.15));
    const auto plain = run_drum(multibody, {}, recorded_drum_program(1.0, 1.0));
    const auto warmer_K = [&](const sim::Recording<double>& run, std::size_t row) {
      return run.channel("liner_temperature_degC")[row] - plain.channel("liner_temperature_degC")[row];
    };
    // it is late by its half minute and no more
    CHECK(warmer_K(wrong, 350) < warmer_K(right, 350));
    CHECK(warmer_K(wrong, 350) > warmer_K(right, 320));
    CHECK(wrong.channel("ambient_degC")[350] == Approx(298.15));
  }
}

TEST_CASE("a vehicle whose speed record is 5 % low takes what it takes 5 % faster, on road and rollers", "[fast]") {
  const auto program = [](double factor) {
    return make_program({driving("up", 40.0, 8.0 * factor, 28.0 * factor),
                         driving("fast", 200.0, 28.0 * factor, 28.0 * factor),
                         driving("down", 30.0, 28.0 * factor, 15.0 * factor)});
  };
  for (const char* rig : {"road", "dyno_1m2"}) {
    for (const bool multibody : {false, true}) {
      INFO(rig << ", multibody " << multibody);
      VehicleFixture fixture(rig);
      const auto right = fixture.run(multibody, program(1.05));
      fixture.effects = {switch_on("speed_record", {5.0})};
      const auto wrong = fixture.run(multibody, program(1.0));
      for (const char* channel : {"traction_force_N", "liner_temperature_degC", "loss_force_N"}) {
        check_same(wrong, right, channel, multibody ? 1e-5 : 1e-9);
      }
      CHECK(wrong.channel("speed_km_h")[100] == Approx(28.0));
    }
  }
}

TEST_CASE("a coasting vehicle's record shows its speed by the same error, and its end", "[fast]") {
  for (const char* rig : {"road", "dyno_1m2"}) {
    for (const bool multibody : {false, true}) {
      INFO(rig << ", multibody " << multibody);
      VehicleFixture fixture(rig);
      fixture.set_load = {100.0, 2.0, 0.4};
      const auto right =
          fixture.run(multibody, make_program({driving("hold", 10.0, 22.0, 22.0), tests::coasting(22.0, 11.0)}));
      fixture.effects = {switch_on("speed_record", {10.0})};
      const auto wrong =
          fixture.run(multibody, make_program({driving("hold", 10.0, 20.0, 20.0), tests::coasting(20.0, 10.0)}));
      CHECK(wrong.phases.back().end_s == Approx(right.phases.back().end_s).epsilon(1e-6));
      for (const std::size_t row : {20u, 40u}) {
        CHECK(wrong.channel("speed_km_h")[row] == Approx(right.channel("speed_km_h")[row] / 1.1).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("on rollers every wheel's true load is off by its own share", "[fast]") {
  VehicleFixture fixture("dyno_1m2", true);
  tests::set_front_load(fixture.vehicle, 0.6);
  fixture.effects = {switch_on("load_record", {5.0, 0.0})};
  for (const bool multibody : {false, true}) {
    const auto recording = fixture.run(multibody, make_program({driving("hold", 60.0, 20.0, 20.0)}));
    for (const rigs::WheelPlace& wheel : fixture.layout().wheels) {
      INFO(wheel.position << ", multibody " << multibody);
      CHECK(recording.channel(rigs::wheel_channel(models::quantities::kContactLoad, wheel)).back() ==
            Approx(1.05 * wheel.static_load_N).epsilon(1e-5));
      CHECK(recording.channel(rigs::wheel_channel(models::quantities::kLoad, wheel)).back() ==
            Approx(wheel.static_load_N));
    }
  }
}
