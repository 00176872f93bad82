// Rollers under the driven wheels alone: the axle that stands still loses nothing.
#include <catch2/catch.hpp>

#include "rigs/vehicle_layout.h"
#include "sim/core/assets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/uneven_machines.h"

using namespace rollrig;

namespace {

rigs::RigFile read_rig(const std::string& name) { return rigs::read_rig(read_config(find_asset("rigs", name))); }

rigs::VehicleFile read_car(double front_drive) {
  rigs::VehicleFile car = rigs::read_vehicle(read_config(find_asset("vehicles", "source_car")));
  tests::set_front_load(car, 0.6);
  tests::set_front_drive(car, front_drive);
  return car;
}

/// What tires take off the target at a speed, by the scenario.
double take_off_N(const std::string& rig, const std::string& fidelity, double speed_m_s) {
  scenarios::RunSpec spec = tests::make_spec(
      "dyno_setting", "a50", {"target_A_N=150", "target_B_N_per_km_h=0", "target_C_N_per_km_h2=0.03"}, fidelity);
  spec.rig = read_rig(rig);
  const Json result = scenarios::run_scenario(spec, {}).result;
  const auto at = [&](const std::string& prefix) {
    const double speed_km_h = 3.6 * speed_m_s;
    return result[prefix + "A_N"].get<double>() +
           speed_km_h * (result[prefix + "B_N_per_km_h"].get<double>() +
                         speed_km_h * result[prefix + "C_N_per_km_h2"].get<double>());
  };
  return at("target_") - at("set_");
}

}  // namespace

TEST_CASE("rollers under the driven wheels: only these roll, and carry the vehicle's whole mass and force", "[fast]") {
  const rigs::RigFile rig = read_rig("dyno_48in_2wd");
  CHECK(rig.driven_wheels_only);
  for (const std::size_t axle : {tests::kFront, tests::kRear}) {
    const rigs::VehicleFile car = read_car(axle == tests::kFront ? 1.0 : 0.0);
    const rigs::VehicleLayout layout = rigs::make_whole_vehicle(car, rig, 293.15, {100.0, 0.0, 0.0});
    REQUIRE(layout.wheels.size() == 2);
    double motor = 0.0, friction = 0.0, load_N = 0.0;
    for (const rigs::WheelPlace& wheel : layout.wheels) {
      CHECK(wheel.axle == axle);
      motor += wheel.motor_share;
      friction += wheel.friction_share;
      load_N += wheel.static_load_N;
    }
    CHECK(motor == Approx(1.0));
    CHECK(friction == Approx(1.0));
    CHECK(layout.rolling_load_N == Approx(load_N));
    CHECK(layout.mass_kg == car.body.mass_kg);
    CHECK(layout.resistance.A_N == 100.0);
    // Half of it: one wheel with half of the mass
    const rigs::VehicleLayout half = rigs::make_one_wheel(car, rig, 293.15, {100.0, 0.0, 0.0}, axle);
    CHECK(half.share == Approx(0.5));
    CHECK(half.rolling_load_N == Approx(half.wheels.front().static_load_N));
    CHECK(half.wheels.front().motor_share == Approx(1.0));
  }
  CHECK(rigs::make_whole_vehicle(read_car(0.5), rig, 293.15, {}).wheels.size() == 4);
  CHECK(rigs::make_whole_vehicle(read_car(0.0), read_rig("dyno_48in"), 293.15, {}).wheels.size() == 4);
}

TEST_CASE("the file of a rig keeps which wheels it rolls", "[fast]") {
  const rigs::RigFile rig = read_rig("dyno_48in_2wd");
  CHECK(rigs::read_rig(parse_config(rigs::write_rig(rig), "rig.toml")).driven_wheels_only);
  CHECK_FALSE(rigs::read_rig(parse_config(rigs::write_rig(read_rig("dyno_48in")), "rig.toml")).driven_wheels_only);
}

TEST_CASE("tires of one axle take off their share of what four take off, in both fidelities", "[slow]") {
  // Each tire of the source's car bears a quarter, so that one axle takes off a half; settings are found to 1 N.
  const double four_N = take_off_N("dyno_48in", "quasi_static", 15.0);
  const double two_N = take_off_N("dyno_48in_2wd", "quasi_static", 15.0);
  CHECK(four_N > 60.0);
  CHECK(two_N == Approx(four_N / 2.0).margin(2.0));
  CHECK(take_off_N("dyno_48in_2wd", "multibody", 15.0) == Approx(two_N).margin(2.0));
}
