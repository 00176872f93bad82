// New tires, rigs and vehicles: what their files promise.
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include <boost/algorithm/string/replace.hpp>

#include "models/tire/own_number.h"
#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"
#include "scenarios/scaffold/class_tire.h"
#include "scenarios/scaffold/iso_test.h"
#include "scenarios/scaffold/new_machine.h"
#include "scenarios/scaffold/tire_size.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using scenarios::ClassTire;

namespace {

NewTireOptions make_request(const char* size, const char* load_index, double rrc_N_per_kN, double pressure_kPa = 0.0) {
  NewTireOptions options;
  options.size = size;
  options.load_index = load_index;
  options.rrc_N_per_kN = rrc_N_per_kN;
  if (pressure_kPa > 0.0) options.pressure_kPa = pressure_kPa;
  return options;
}

/// Of each class, light and heavy, narrow and wide.
std::vector<NewTireOptions> list_requests() {
  return {make_request("205/55R16", "91", 8.2),
          make_request("165/70R14", "81", 9.5),
          make_request("275/40 R21", "107", 6.4),
          make_request("195/75R16C", "107/105", 8.0, 475.0),
          make_request("215/75R17.5", "135/133", 6.5, 850.0),
          make_request("315/80R22.5", "156/150", 5.5, 850.0)};
}

/// Loss of an ISO test at an air temperature, relative to that at 25 degC.
double measure_class_slope_per_K(const models::TireFile& tire) {
  const auto rrc_at = [&tire](const char* air) {
    scenarios::RunSpec spec = tests::make_spec("iso_28580", "a50", {air, "warm_up_min=300"}, "quasi_static");
    spec.tire = tire;
    return tests::number(scenarios::run_scenario(spec, {}), "rrc_N_per_kN");
  };
  return (rrc_at("ambient_degC=20") - rrc_at("ambient_degC=30")) / (10.0 * rrc_at("ambient_degC=25"));
}

}  // namespace

TEST_CASE("sizes of tires are read as their sidewalls have them", "[fast]") {
  const scenarios::TireSize size = scenarios::parse_tire_size("205/55R16");
  CHECK(size.outer_diameter_m == Approx(0.6319));
  CHECK(size.designation == "205/55 R16");
  CHECK(scenarios::parse_tire_size("205/55 ZR16 91W").load_index == "91");
  CHECK(scenarios::parse_tire_size("195/75R16C 107/105R").is_commercial);
  CHECK(scenarios::parse_tire_size("LT245/75R16").is_commercial);
  CHECK(scenarios::parse_tire_size("315/80R22.5").rim_diameter_m == Approx(0.5715));
  for (const char* wrong : {"205-55-16", "20/55R16", "205/55R160", "2055516", "", "990/55R16"}) {
    INFO(wrong);
    CHECK_THROWS_AS(scenarios::parse_tire_size(wrong), InputError);
  }
}

TEST_CASE("a service description is read from size or load index, and its parts must agree", "[fast]") {
  CHECK(scenarios::parse_service_description("91").speed_symbol.empty());
  CHECK(scenarios::parse_service_description("91v").speed_symbol == "V");
  CHECK(scenarios::parse_service_description("156/150 L").load_index == 156);
  CHECK(scenarios::parse_service_description("156/150 L").speed_symbol == "L");
  CHECK_THROWS_AS(scenarios::parse_service_description("91O"), InputError);
  CHECK(scenarios::parse_service_description("156/150").dual_index == 150);
  CHECK_THROWS_AS(scenarios::parse_service_description("107/109T"), InputError);  // dual above single mounting
  const scenarios::TireSize van = scenarios::parse_tire_size("225/75R16C");
  CHECK(scenarios::find_tire_class(van, {121, 120, "R"}) == "C2");
  CHECK(scenarios::find_tire_class(van, {121, 120, "M"}) == "C3");  // UN R117, 2.4
  CHECK(scenarios::find_tire_class(van, {121, 120, ""}) == "C2");
  CHECK(scenarios::doubt_class_by_size("C1", true, {91, 0, "V"}).has_value());
  CHECK_FALSE(scenarios::doubt_class_by_size("C1", false, {91, 0, "V"}).has_value());
  NewTireOptions reversed;
  reversed.size = "215/65R16C 107/109T";
  reversed.rrc_N_per_kN = 8.4;
  CHECK_THROWS_WITH(scenarios::make_class_tire(reversed), Catch::Contains("--size"));
  CHECK_THROWS_AS(scenarios::parse_tire_size("205/55R16 91O"), InputError);
  NewTireOptions options;
  options.size = "205/55R16 91V";
  options.rrc_N_per_kN = 8.4;
  CHECK(scenarios::make_class_tire(options).service.speed_symbol == "V");
  options.speed_symbol = "H";
  CHECK_THROWS_AS(scenarios::make_class_tire(options), InputError);
  options.speed_symbol = "";
  options.load_index = "91V";
  const ClassTire made = scenarios::make_class_tire(options);
  CHECK(made.notes.at("service_description.speed_symbol") == "Given");
  CHECK(made.notes.at("service_description.class") == "Assumed by size and load index");
  for (const char* other : {"91H", "94", "94V"}) {
    options.load_index = other;
    CHECK_THROWS_AS(scenarios::make_class_tire(options), InputError);
  }
}

TEST_CASE("load indices give the loads of the regulation", "[fast]") {
  const std::vector<std::pair<const char*, double>> known{
      {"60", 250.0},   {"61", 257.0},   {"91", 615.0},   {"103", 875.0},      {"121", 1450.0}, {"139", 2430.0},
      {"140", 2500.0}, {"141", 2575.0}, {"156", 4000.0}, {"156/150", 4000.0}, {"179", 7750.0}};
  for (const auto& [index, load_kg] : known) {
    INFO(index);
    CHECK(scenarios::find_load_capacity_N(index) == Approx(9.80665 * load_kg));
  }
  for (const char* wrong : {"", "59", "180", "ninety", "9"}) {
    CHECK_THROWS_AS(scenarios::find_load_capacity_N(wrong), InputError);
  }
}

TEST_CASE("a tire property file gives the RRc of a new tire, on the 2 m drum more than on its flat surface", "[fast]") {
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("a.tir");
  const std::string text =
      "[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nTIME = 'second'\n[MODEL]\nFITTYP = 62\nLONGVL = 16.7\n"
      "[DIMENSION]\nUNLOADED_RADIUS = 0.32\n[VERTICAL]\nFNOMIN = 4000\n[OPERATING_CONDITIONS]\nNOMPRES = 210000\n"
      "[ROLLING_COEFFICIENTS]\nQSY1 = 0.008\nQSY3 = 0\nQSY4 = 0\nQSY7 = 0.85\nQSY8 = -0.4\n";
  tests::write_file(path, text);
  NewTireOptions request = make_request("205/55R16", "91", 0.0);
  request.tir = path;
  const ClassTire made = scenarios::make_class_tire(request);
  const double load_N = made.tire.iso_28580->load_N;
  // (3.1) between a flat surface and a drum of radius 1 m is the root of 1 + tire radius
  const double expected = 0.008 * std::pow(load_N / 4000.0, -0.15) * std::sqrt(1.32);
  CHECK(made.tire.iso_28580->rrc == Approx(expected).epsilon(1e-4));
  CHECK(scenarios::simulate_iso_rrc(made.tire) == Approx(expected).epsilon(3e-4));
  CHECK(made.warnings.empty());

  request.pressure_kPa = 250.0;  // loses less at more pressure
  CHECK(scenarios::make_class_tire(request).tire.iso_28580->rrc / made.tire.iso_28580->rrc ==
        Approx(std::pow(250.0 / 210.0, -0.4)).epsilon(1e-3));
  request.rrc_N_per_kN = 8.0;
  CHECK_THROWS_AS(scenarios::make_class_tire(request), InputError);
  request.rrc_N_per_kN = 0.0;
  tests::write_file(path, boost::algorithm::replace_all_copy(text, "QSY1 = 0.008", "QSY1 = 0"));
  CHECK_THROWS_AS(scenarios::make_class_tire(request), InputError);
}

TEST_CASE("a new tire has its RRc in the simulated test of ISO 28580, in both fidelities", "[slow]") {
  for (const NewTireOptions& request : list_requests()) {
    INFO(request.size);
    const ClassTire made = scenarios::make_class_tire(request);
    const models::TireFile tire = models::read_tire(parse_config(scenarios::write_class_tire(made), "new.toml"));
    CHECK(1e3 * scenarios::simulate_iso_rrc(tire) == Approx(request.rrc_N_per_kN).epsilon(1e-4));  // as written
    CHECK_FALSE(scenarios::check_iso_rrc(tire).has_value());
    scenarios::RunSpec spec = tests::make_spec("iso_28580", "a50", {}, "multibody");
    spec.tire = tire;
    spec.rig = rigs::read_rig(read_config(find_asset("rigs", "drum_2m")));
    rigs::use_skim_load_of_class(spec.rig, tire);
    const double rrc = tests::number(scenarios::run_scenario(spec, {}), "rrc_25degC_2m_N_per_kN");
    CHECK(rrc == Approx(request.rrc_N_per_kN).epsilon(3e-4));  // README.md: fidelities differ by less than 0.01 %
  }
}

TEST_CASE("a new tire of the size and RRc of a reference tire is that tire", "[fast]") {
  const std::vector<std::pair<const char*, NewTireOptions>> known{
      {"c1_205_55r16", make_request("205/55R16", "91", 8.4)},
      {"c3_315_80r22_5", make_request("315/80R22.5", "156/150", 5.55, 850.0)}};
  for (const auto& [name, request] : known) {
    INFO(name);
    const models::TireFile asset = tests::read_asset_tire(name);
    const models::TireFile made = scenarios::make_class_tire(request).tire;
    // the asset has round numbers
    CHECK(made.values.geometry.mass_kg == Approx(asset.values.geometry.mass_kg).epsilon(0.01));
    CHECK(made.iso_28580->load_N == Approx(asset.iso_28580->load_N).epsilon(0.002));
    CHECK(made.values.stiffness.vertical_N_per_m == Approx(asset.values.stiffness.vertical_N_per_m).epsilon(0.01));
    CHECK(made.values.thermal.heat_capacity_J_per_K ==
          Approx(asset.values.thermal.heat_capacity_J_per_K).epsilon(0.01));
    CHECK(*models::find_own_number(made.values.own, "loss_N") ==
          Approx(*models::find_own_number(asset.values.own, "loss_N")).epsilon(0.005));
  }
}

TEST_CASE("every number of a new tire has a source, and what decides its loss an uncertainty", "[fast]") {
  for (const NewTireOptions& request : list_requests()) {
    const ClassTire made = scenarios::make_class_tire(request);
    std::istringstream in(scenarios::write_class_tire(made));
    for (std::string line; std::getline(in, line);) {
      if (line.find(" = ") == std::string::npos || line.find('"') != std::string::npos || line.front() == '#') continue;
      INFO(request.size << ": " << line);
      CHECK(line.find("# ") != std::string::npos);
    }
    const models::TireParameters<double>& sd = made.tire.standard_uncertainties;
    CHECK(sd.thermal.heat_capacity_J_per_K > 0.0);
    CHECK(sd.rolling_resistance.pressure_exponent > 0.0);
    for (const char* key : {"loss_N", "speed_rise", "fall_per_degC", "load_exponent", "conductance_W_per_K"}) {
      INFO(key);
      CHECK(*models::find_own_number(sd.own, key) > 0.0);
    }
  }
}

TEST_CASE("new tires fall with the temperature of the air as their class does", "[fast]") {
  // K_t of UN R117, Annex 6, 6.2, within a tenth, since sizes differ in how warm they run
  const std::vector<NewTireOptions> requests = list_requests();
  for (const auto& [request, slope_per_K] :
       std::vector<std::pair<std::size_t, double>>{{0, 0.008}, {3, 0.010}, {5, 0.006}}) {
    INFO(requests[request].size);
    CHECK(measure_class_slope_per_K(scenarios::make_class_tire(requests[request]).tire) ==
          Approx(slope_per_K).epsilon(0.1));
  }
}

TEST_CASE("a tire whose law and label disagree is warned of beyond a hundredth", "[fast]") {
  for (const std::string& name : list_assets("tires")) {
    INFO(name);
    CHECK_FALSE(scenarios::check_iso_rrc(tests::read_asset_tire(name)).has_value());
  }
  models::TireFile tire = tests::read_asset_tire("c1_205_55r16");
  const double rrc = scenarios::simulate_iso_rrc(tire);
  tire.iso_28580->rrc = rrc / 1.009;
  CHECK_FALSE(scenarios::check_iso_rrc(tire).has_value());
  tire.iso_28580->rrc = rrc / 1.011;
  CHECK(scenarios::check_iso_rrc(tire).has_value());
}

TEST_CASE("a new rig has the given numbers, and all others of the rig of its kind", "[fast]") {
  NewRigOptions options;
  options.diameter_m = 1.7;
  options.bearing_loss_N = 9.0;
  options.name = "mine";
  const rigs::RigFile rig = rigs::read_rig(parse_config(scenarios::write_new_rig(options), "mine.toml"));
  CHECK(rig.name == "mine");
  CHECK(rig.drum.diameter_m == Approx(1.7));
  const double speed_m_s = 80.0 / 3.6;
  CHECK(rig.parasitic.c0_N + rig.parasitic.c1_N_s_per_m * speed_m_s +
            rig.parasitic.c2_N_s2_per_m2 * speed_m_s * speed_m_s ==
        Approx(9.0).epsilon(1e-5));
  CHECK(rig.drum.inertia_kg_m2 == Approx(280.0).epsilon(0.05));  // that of a drum of 1.707 m
  CHECK(rig.carriage.mass_kg == Approx(155.0));
  for (const char* kind : {"flat_belt", "dyno"}) {
    NewRigOptions other;
    other.kind = kind;
    CHECK(rigs::read_rig(parse_config(scenarios::write_new_rig(other), "other.toml")).kind->word == std::string(kind));
  }
}

TEST_CASE("a new vehicle coasts down as its road load says", "[fast]") {
  NewVehicleOptions options;
  options.mass_kg = 1900.0;
  options.road_load = {150.0, 0.2, 0.034};
  const rigs::VehicleFile vehicle = rigs::read_vehicle(parse_config(scenarios::write_new_vehicle(options), "v.toml"));
  CHECK(vehicle.body.mass_kg == Approx(1900.0));
  CHECK(vehicle.count_wheels() == 4);
  REQUIRE(vehicle.road_load.has_value());
  CHECK(0.5 * 1.167 * vehicle.body.drag_area_m2 == Approx(0.034 * 3.6 * 3.6).epsilon(1e-5));
}

TEST_CASE("a new file is not named what its own reader or a folder would refuse", "[fast]") {
  for (const char* name : {"a\"b", "a/b", "a\\b", "a\nb"}) {
    INFO(name);
    NewTireOptions tire = make_request("205/55R16", "91", 8.2);
    tire.name = name;
    CHECK_THROWS_AS(scenarios::make_class_tire(tire), InputError);
    NewRigOptions rig;
    rig.name = name;
    rig.diameter_m = 1.7;
    CHECK_THROWS_WITH(scenarios::write_new_rig(rig), Catch::Contains("--name"));
    NewVehicleOptions vehicle;
    vehicle.mass_kg = 1900.0;
    vehicle.drag_area_m2 = 0.7;
    vehicle.name = name;
    CHECK_THROWS_AS(scenarios::write_new_vehicle(vehicle), InputError);
  }
  NewTireOptions tire = make_request("205/55R16", "91", 8.2);
  tire.name = "Sommer, süß #2";
  CHECK(scenarios::make_class_tire(tire).tire.name == tire.name);
}
