// Vehicle files: axles of format /2, and what format /1 said of its two axles.
#include "rigs/vehicle_file.h"

#include <catch2/catch.hpp>

#include "tests/support/vehicle_fixture.h"

using namespace rollrig;
using tests::driving;
using tests::VehicleFixture;

namespace {

const std::string kBody = "name = \"car\"\nmass_kg = 2100.0\nrotating_mass_kg = 80.0\ndrag_area_m2 = 0.7\n";

rigs::VehicleFile read(const std::string& format, const std::string& more) {
  return rigs::read_vehicle(parse_config("format = \"rollrig-vehicle/" + format + "\"\n" + kBody + more, "car.toml"));
}

void check_same_vehicle(const rigs::VehicleFile& a, const rigs::VehicleFile& b) {
  CHECK(a.center_of_gravity_height_m == b.center_of_gravity_height_m);
  CHECK(a.powertrain.efficiency == b.powertrain.efficiency);
  REQUIRE(a.axles.size() == b.axles.size());
  for (std::size_t i = 0; i < a.axles.size(); ++i) {
    INFO(a.axles[i].name);
    CHECK(a.axles[i].name == b.axles[i].name);
    CHECK(rigs::write_vehicle(a) == rigs::write_vehicle(b));
  }
}

}  // namespace

TEST_CASE("format /1 is a front and a rear axle with what its keys say, or its defaults", "[fast]") {
  const rigs::VehicleFile plain = read("1", "tires = 4\n");
  REQUIRE(plain.axles.size() == 2);
  CHECK(plain.axles[0].name == "front");
  CHECK(plain.axles[1].name == "rear");
  CHECK(plain.axles[1].position_m == 2.9);
  CHECK(plain.axles[0].load_share == 0.5);
  CHECK(plain.axles[0].drive_share == 0.0);
  CHECK(plain.axles[1].drive_share == 1.0);
  CHECK(plain.axles[0].brake_share == 0.65);
  CHECK(plain.axles[1].brake_share == 1.0 - 0.65);
  CHECK(plain.axles[0].suspension.stiffness_N_per_m == 35000.0);
  CHECK(plain.center_of_gravity_height_m == 0.6);

  const rigs::VehicleFile full = read("1",
                                      "tires = 4\n[geometry]\nwheelbase_m = 2.6\ncentre_of_gravity_height_m = 0.55\n"
                                      "front_load_share = 0.57\n[suspension]\nunsprung_mass_kg = 30.0\n"
                                      "[powertrain]\ndriven_axle = \"all\"\n[brakes]\nfront_share = 0.7\n");
  CHECK(full.axles[1].position_m == 2.6);
  CHECK(full.axles[0].load_share == 0.57);
  CHECK(full.axles[1].load_share == 1.0 - 0.57);
  CHECK(full.axles[0].drive_share == 0.5);
  CHECK(full.axles[0].brake_share == 0.7);
  CHECK(full.axles[1].suspension.unsprung_mass_kg == 30.0);
  CHECK(full.center_of_gravity_height_m == 0.55);
  CHECK(read("1", "tires = 4\n[powertrain]\ndriven_axle = \"front\"\n").axles[0].drive_share == 1.0);
  check_same_vehicle(full, read("1",
                                "tires = 4\n[geometry]\nwheelbase_m = 2.6\ncenter_of_gravity_height_m = 0.55\n"
                                "front_load_share = 0.57\n[suspension]\nunsprung_mass_kg = 30.0\n"
                                "[powertrain]\ndriven_axle = \"all\"\n[brakes]\nfront_share = 0.7\n"));
}

TEST_CASE("a set of the road may count any number of tires", "[fast]") {
  for (const int tires : {1, 2, 3, 4, 6, 20}) {
    const rigs::VehicleFile vehicle = read("1", "tires = " + std::to_string(tires) + "\n");
    INFO(tires);
    CHECK(vehicle.count_wheels() == tires);
    CHECK(rigs::read_vehicle(parse_config(rigs::write_vehicle(vehicle), "car.toml")).count_wheels() == tires);
  }
}

TEST_CASE("format /2 says the same as /1, is written and read again", "[fast]") {
  const rigs::VehicleFile old_format = read("1",
                                            "tires = 4\n[geometry]\nfront_load_share = 0.75\nwheelbase_m = 2.5\n"
                                            "[powertrain]\nefficiency = 0.9\n[brakes]\nfront_share = 0.625\n");
  const rigs::VehicleFile vehicle =
      read("2",
           "[powertrain]\nefficiency = 0.9\n[[axle]]\nposition_m = 0.0\nload_share = 0.75\nbrake_share = 0.625\n"
           "[[axle]]\nposition_m = 2.5\nload_share = 0.25\ndrive_share = 1.0\nbrake_share = 0.375\n");
  check_same_vehicle(old_format, vehicle);
  check_same_vehicle(vehicle, rigs::read_vehicle(parse_config(rigs::write_vehicle(vehicle), "car.toml")));
}

TEST_CASE("a battery and a map of the powertrain are read in both formats, written and read again", "[fast]") {
  const std::string more =
      "[powertrain]\nauxiliary_power_W = 350.0\n[powertrain.map]\nspeeds_km_h = [0.0, 36.0, 120.0]\n"
      "powers_kW = [-40.0, 80.0]\nefficiency = [[0.5, 0.7], [0.8, 0.9], [0.75, 0.92]]\n"
      "[battery]\nusable_energy_kWh = 67.2\nrecharge_energy_kWh = 75.6\n";
  const rigs::VehicleFile vehicle = read("1", "tires = 4\n" + more);
  REQUIRE(vehicle.powertrain.map.has_value());
  CHECK(vehicle.powertrain.auxiliary_power_W == 350.0);
  CHECK(vehicle.powertrain.map->speeds_m_s[1] == Approx(10.0));
  CHECK(vehicle.powertrain.map->powers_W == std::vector<double>{-40e3, 80e3});
  CHECK(vehicle.powertrain.map->efficiency[2] == std::vector<double>{0.75, 0.92});
  REQUIRE(vehicle.battery.has_value());
  CHECK(vehicle.battery->usable_J == Approx(67.2 * 3.6e6));
  CHECK(vehicle.battery->calc_recharge_J() == Approx(75.6 * 3.6e6));
  const std::string written = rigs::write_vehicle(vehicle);
  CHECK(written == rigs::write_vehicle(rigs::read_vehicle(parse_config(written, "car.toml"))));
  const rigs::VehicleFile plain = read("1", "tires = 4\n");
  CHECK_FALSE(plain.powertrain.map.has_value());
  CHECK_FALSE(plain.battery.has_value());
  CHECK(plain.powertrain.calc_regeneration_efficiency() == plain.powertrain.efficiency);
}

TEST_CASE("axles have names, tires, pressures and suspensions of their own", "[fast]") {
  const rigs::VehicleFile vehicle =
      read("2",
           "[[axle]]\nposition_m = 0.0\nload_share = 0.5\nbrake_share = 0.5\ntire = \"a40\"\npressure_kPa = 250.0\n"
           "[[axle]]\nname = \"middle\"\nposition_m = 2.0\nload_share = 0.3\ndrive_share = 1.0\nbrake_share = 0.3\n"
           "wheels = 4\n[axle.suspension]\nstiffness_N_per_m = 50000.0\n"
           "[[axle]]\nposition_m = 3.0\nload_share = 0.2\nbrake_share = 0.2\nwheels = 1\n");
  REQUIRE(vehicle.axles.size() == 3);
  CHECK(vehicle.axles[0].name == "axle_1");
  CHECK(vehicle.axles[2].name == "axle_3");
  CHECK(vehicle.axles[0].tire->name == "a40");
  CHECK_FALSE(vehicle.axles[1].tire.has_value());
  CHECK(vehicle.axles[0].pressure_Pa == 250e3);
  CHECK(vehicle.axles[1].suspension.stiffness_N_per_m == 50000.0);
  CHECK(vehicle.axles[2].suspension.stiffness_N_per_m == 35000.0);
  CHECK(vehicle.count_wheels() == 7);
  CHECK(rigs::list_driven_axles(vehicle) == "middle");
  const auto names = [&](std::size_t axle) { return rigs::name_wheels(vehicle, vehicle.axles[axle]); };
  CHECK(names(0) == std::vector<std::string>{"axle_1_left", "axle_1_right"});
  CHECK(names(1) ==
        std::vector<std::string>{"middle_left_outer", "middle_left_inner", "middle_right_inner", "middle_right_outer"});
  CHECK(names(2) == std::vector<std::string>{"axle_3"});
  // The weight acts in the axles' loads: 0.3 of it 2 m and 0.2 of it 3 m behind the first axle.
  CHECK(vehicle.calc_x_m(vehicle.axles[0]) == Approx(1.2));
  CHECK(vehicle.calc_x_m(vehicle.axles[2]) == Approx(-1.8));
}

TEST_CASE("a car in format /2 drives as in format /1, to the bit", "[fast]") {
  const auto program = tests::make_program(
      {driving("speed up", 10.0, 0.0, 20.0), driving("hold", 20.0, 20.0, 20.0), driving("brake", 5.0, 20.0, 2.0)});
  for (const char* rig : {"dyno_1m2", "road"}) {
    VehicleFixture in_1(rig, true);
    VehicleFixture in_2(rig, true);
    in_1.vehicle = read("1", "tires = 4\n[geometry]\nfront_load_share = 0.5625\n[brakes]\nfront_share = 0.6875\n");
    in_2.vehicle = rigs::read_vehicle(parse_config(rigs::write_vehicle(in_1.vehicle), "car.toml"));
    for (const bool multibody : {false, true}) {
      INFO(rig << (multibody ? ", multibody" : ", quasi-static"));
      CHECK(in_1.run(multibody, program).values == in_2.run(multibody, program).values);
    }
  }
}
