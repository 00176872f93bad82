// Phase scaling of a multi-cycle test against a public certificate and against driving a battery empty; what of the
// cold first section the tires explain; batteries and powertrains of the vehicle's file.
#include "scenarios/common/multi_cycle_energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "build_paths.h"
#include "sim/core/assets.h"
#include "sim/core/csv.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using scenarios::calc_economy;
using scenarios::calc_phase_weights;
using scenarios::CycleEconomy;
using scenarios::EnergySection;

namespace {

constexpr double kWh = 3.6e6;                     // J in 1 kWh
constexpr double kWhPerMile = 3600.0 / 1609.344;  // J/m in 1 Wh/mi
const std::vector<std::string> kShort{"mid_min=5", "end_min=5"};

struct Certificate {
  std::vector<EnergySection> city;
  std::vector<EnergySection> highway;
  double all_J = 0.0;
};

Certificate read_certificate() {
  const CsvTable table = CsvTable::read(ROLLRIG_SOURCE_DIR "/tests/published/ex30_multi_cycle/phases.csv");
  const std::vector<std::string> kind = table.text("kind");
  const std::vector<double> miles = table.numbers({"miles", positive(), ""});
  const std::vector<double> battery_kWh = table.numbers({"dc_kwh", positive(), ""});
  Certificate certificate;
  for (std::size_t i = 0; i < kind.size(); ++i) {
    const EnergySection section{kWh * battery_kWh[i], 1609.344 * miles[i]};
    certificate.all_J += section.battery_J;
    if (kind[i] == "udds") certificate.city.push_back(section);
    if (kind[i] == "hwfet") certificate.highway.push_back(section);
  }
  return certificate;
}

/// A multi-cycle test, quasi-static, that a test may change before it runs.
scenarios::RunSpec make_j1634(const std::vector<std::string>& settings = kShort, const std::string& rig = "dyno_1m2") {
  scenarios::RunSpec spec = tests::make_spec("sae_j1634", "a50", settings, "quasi_static");
  spec.rig = rigs::read_rig(read_config(find_asset("rigs", rig)));
  return spec;
}

double number_of(const Json& result, const char* key) { return result[key].get<double>(); }

models::PowertrainMap make_even_map(double efficiency) {
  return {{0.0, 10.0, 60.0},
          {-300e3, 0.0, 300e3},
          {{efficiency, efficiency, efficiency},
           {efficiency, efficiency, efficiency},
           {efficiency, efficiency, efficiency}}};
}

}  // namespace

TEST_CASE("phase scaling gives a certificate's usable energy, consumption and ranges from its eight sections",
          "[fast]") {
  const Certificate certificate = read_certificate();
  REQUIRE(certificate.city.size() == 4);
  REQUIRE(certificate.highway.size() == 2);
  const scenarios::MultiCycleEconomy economy =
      scenarios::calc_multi_cycle_economy(certificate.city, certificate.highway, {certificate.all_J, 75.559 * kWh});
  // The certificate (README.md beside its sections), within the rounding of its sections: 0.05 Wh of 1.2 kWh, 0.0005
  // of 7.4 mi.
  CHECK(economy.charge.usable_J / 3600.0 == Approx(67198.7).margin(0.05));
  CHECK(economy.city.dc_J_per_m / kWhPerMile == Approx(165.56).margin(0.01));
  CHECK(economy.highway.dc_J_per_m / kWhPerMile == Approx(201.16).margin(0.01));
  CHECK(economy.city.range_m / 1609.344 == Approx(405.883).margin(0.02));
  CHECK(economy.highway.range_m / 1609.344 == Approx(334.064).margin(0.02));
  // What the mains give is the range's share of the recharge.
  CHECK(*economy.city.ac_J_per_m * economy.city.range_m == Approx(75.559 * kWh));
}

TEST_CASE("weights of phase scaling sum to 1, and equal cycles give what each of them takes", "[fast]") {
  const std::vector<double> weights = calc_phase_weights({{2e6, 1e4}, {1e6, 1e4}, {1e6, 1e4}, {1e6, 1e4}}, 5e7);
  CHECK(weights.front() == Approx(0.04));
  CHECK(std::accumulate(weights.begin(), weights.end(), 0.0) == Approx(1.0));
  for (const double usable_J : {1e7, 3e8}) {
    const std::vector<EnergySection> alike(4, {1.3e6, 11900.0});
    const CycleEconomy economy = calc_economy(alike, calc_phase_weights(alike, usable_J), {usable_J});
    CHECK(economy.dc_J_per_m == Approx(1.3e6 / 11900.0));
    CHECK(economy.range_m == Approx(usable_J / 1.3e6 * 11900.0));
  }
}

TEST_CASE("the range by phase scaling is that of a battery driven empty, cycle by cycle", "[fast]") {
  const double warm_J = 4.3e6;
  const double cold_J = 1.15 * warm_J;
  const double cycle_m = 11990.0;
  const double usable_J = 67.2 * kWh;
  double driven_m = cycle_m;
  double left_J = usable_J - cold_J;
  for (; left_J >= warm_J; left_J -= warm_J) driven_m += cycle_m;
  driven_m += left_J / warm_J * cycle_m;
  const std::vector<EnergySection> cycles{{cold_J, cycle_m}, {warm_J, cycle_m}, {warm_J, cycle_m}, {warm_J, cycle_m}};
  const CycleEconomy economy = calc_economy(cycles, calc_phase_weights(cycles, usable_J), {usable_J});
  // Weights are shares of energy, not of distance: an error of K_1 times the square of the excess, 0.0005.
  CHECK(economy.range_m == Approx(driven_m).epsilon(1e-3));
  // Equal weights would be wrong by 3 %.
  CHECK(usable_J / (0.25 * (cold_J + 3.0 * warm_J) / cycle_m) < 0.97 * driven_m);
}

TEST_CASE("city and highway combine as in the example of the regulation, 33.7 kWh for 100 miles are 100 MPGe",
          "[fast]") {
  // 10 CFR 474, appendix, example 1: 265 and 220 Wh/mi, 244.75 combined.
  const CycleEconomy city{265.0 * kWhPerMile, 4e5, 300.0 * kWhPerMile};
  const CycleEconomy highway{220.0 * kWhPerMile, 3e5, 250.0 * kWhPerMile};
  CHECK(scenarios::combine_economy(city, highway).dc_J_per_m / kWhPerMile == Approx(244.75));
  CHECK(scenarios::calc_mpge(337.0 * kWhPerMile) == Approx(100.0));
}

TEST_CASE("on its road load alone, without tires that warm up, no section is colder than another", "[fast]") {
  scenarios::RunSpec spec = make_j1634({"mid_min=5", "end_min=5"}, "road");
  spec.vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "volvo_ex30")));
  const Json result = scenarios::run_scenario(spec, {}).result;
  CHECK(std::abs(number_of(result, "first_city_excess_percent")) < 1e-4);
  CHECK(number_of(result, "first_city_tire_excess_Wh") == 0.0);
  CHECK_FALSE(result.contains("first_city_tire_share_percent"));  // of nothing
}

TEST_CASE("where only the tires warm up they explain the first section, beside a driveline a part of it", "[fast]") {
  const auto share = [](const std::vector<std::string>& more) {
    std::vector<std::string> settings = kShort;
    settings.insert(settings.end(), more.begin(), more.end());
    const Json result = scenarios::run_scenario(make_j1634(settings), {}).result;
    CHECK(number_of(result, "first_city_excess_percent") > 0.0);
    return number_of(result, "first_city_tire_share_percent");
  };
  // The rest is of the friction brakes, which do not brake what the tires do.
  CHECK(share({}) == Approx(100.0).margin(3.0));
  const double beside_driveline = share({"effects.driveline_warming.force_N=14"});
  CHECK(beside_driveline > 10.0);
  CHECK(beside_driveline < 80.0);
}

TEST_CASE("without a battery the test takes all of it, with one, its own energy scales the phases", "[fast]") {
  scenarios::RunSpec spec = make_j1634({"mid_min=5", "end_min=60"});
  const scenarios::Outcome by_sections = scenarios::run_scenario(spec, {});
  REQUIRE(by_sections.warnings.size() == 1);
  CHECK(by_sections.warnings[0].find("the vehicle has no [battery]") != std::string::npos);
  const Json& without = by_sections.result;
  double all_Wh = 0.0;
  for (const Json& section : without["sections"]) all_Wh += number_of(section, "battery_energy_Wh");
  CHECK(number_of(without, "usable_energy_kWh") == Approx(1e-3 * all_Wh));
  CHECK(without["usable_energy_from"] == "sections");
  CHECK(without["economy"][0]["ac_consumption_Wh_per_km"].is_null());
  CHECK_FALSE(without.contains("recharge_energy_kWh"));

  spec.vehicle->battery = rigs::VehicleBattery{60.0 * kWh, 0.0, 0.8};
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const Json& with = outcome.result;
  CHECK(with["sections"] == without["sections"]);
  CHECK(with["usable_energy_from"] == "battery");
  CHECK(number_of(with, "recharge_energy_kWh") == Approx(75.0));
  CHECK(with["recharge_energy_from"] == "assumed: charging_efficiency = 0.8");
  for (const Json& cycle : with["economy"]) {
    INFO(cycle["name"]);
    CHECK(number_of(cycle, "ac_consumption_Wh_per_km") == Approx(number_of(cycle, "dc_consumption_Wh_per_km") / 0.8));
    CHECK(number_of(cycle, "dc_mi_per_kWh") * number_of(cycle, "dc_consumption_Wh_per_km") ==
          Approx(1000.0 / 1.609344));
    CHECK(number_of(cycle, "label_range_mi") == Approx(0.7 * number_of(cycle, "range_mi")));
  }
  // An end section of the length that is named empties it.
  REQUIRE(outcome.warnings.size() == 1);
  CHECK(outcome.warnings.front().find("end_min=") != std::string::npos);
  scenarios::RunSpec longer = make_j1634({"mid_min=5", fmt::format("end_min={}", number_of(with, "end_needed_min"))});
  longer.vehicle->battery = spec.vehicle->battery;
  const scenarios::Outcome emptied = scenarios::run_scenario(longer, {});
  all_Wh = 0.0;
  for (const Json& section : emptied.result["sections"]) all_Wh += number_of(section, "battery_energy_Wh");
  CHECK(all_Wh == Approx(60e3).epsilon(0.002));
  CHECK(emptied.warnings.empty());
}

TEST_CASE("a charge that loses much is doubted, and one that was measured is called so", "[fast]") {
  scenarios::RunSpec spec = make_j1634({"mid_min=5", "end_min=60"});
  spec.vehicle->battery = rigs::VehicleBattery{60.0 * kWh, 68.0 * kWh, 0.9};
  const auto find_doubt = [&spec] {
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    CHECK(outcome.result["recharge_energy_from"] == "recharge_energy_kWh");
    return std::any_of(outcome.warnings.begin(), outcome.warnings.end(), [](const std::string& warning) {
      return warning.find("of its recharge energy") != std::string::npos;
    });
  };
  CHECK_FALSE(find_doubt());
  spec.vehicle->battery->recharge_J = 168.0 * kWh;
  CHECK(find_doubt());
  spec.vehicle->battery->recharge_J = 60.0 * kWh;  // the direct current copied
  CHECK(find_doubt());
}

TEST_CASE("a road load that stands for the tires is said to, tires that roll are not", "[fast]") {
  const auto says = [](const char* rig) {
    scenarios::RunSpec spec = make_j1634(kShort, rig);
    spec.vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "volvo_ex30")));
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    return std::any_of(outcome.warnings.begin(), outcome.warnings.end(), [](const std::string& warning) {
      return warning.find("the model of the tire is not used") != std::string::npos;
    });
  };
  CHECK(says("road"));
  CHECK_FALSE(says("dyno_1m2"));
}

TEST_CASE("a road load in lbf of a vehicle's file is doubted", "[fast]") {
  scenarios::RunSpec spec = tests::make_spec("drive_cycle", "a50", {"cycle=us06"}, "quasi_static");
  spec.vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "volvo_ex30")));
  const auto has_doubt = [&spec] {
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    return std::any_of(outcome.warnings.begin(), outcome.warnings.end(), [](const std::string& warning) {
      return warning.find("[road_load] of vehicle") != std::string::npos;
    });
  };
  CHECK_FALSE(has_doubt());
  constexpr double kLbf_N = 4.4482216;
  auto& load = *spec.vehicle->road_load;
  load = {load.A_N / kLbf_N, load.B_N_s_per_m / kLbf_N * 1.609344, load.C_N_s2_per_m2 / kLbf_N * 1.609344 * 1.609344};
  CHECK(has_doubt());
}

TEST_CASE("the order of the source has no phase scaling", "[fast]") {
  const Json result = scenarios::run_scenario(make_j1634({"variant=source", "mid_min=5", "end_min=5"}), {}).result;
  for (const char* key : {"usable_energy_kWh", "economy", "first_city_excess_percent"})
    CHECK_FALSE(result.contains(key));
}

TEST_CASE("a battery that is empty before the end section is refused with what it would need", "[fast]") {
  scenarios::RunSpec spec = make_j1634();
  spec.vehicle->battery = rigs::VehicleBattery{5.0 * kWh, 0.0, 0.9};
  CHECK_THROWS_WITH(scenarios::run_scenario(spec, {}), Catch::Contains("usable_energy_kWh") &&
                                                           Catch::Contains("mid_min") &&
                                                           Catch::Contains("empty before the end section"));
}

TEST_CASE("a map that is even is the constant efficiency, in both fidelities", "[slow]") {
  for (const char* fidelity : {"quasi_static", "multibody"}) {
    INFO(fidelity);
    const auto drive = [fidelity](bool with_map) {
      scenarios::RunSpec spec =
          tests::make_spec("drive_cycle", "a50", {"wheels=1", "wheel_of=rear", "cycle=us06"}, fidelity);
      spec.vehicle->powertrain.efficiency = 0.8;
      if (with_map) spec.vehicle->powertrain.map = make_even_map(0.8);
      return number_of(scenarios::run_scenario(spec, {}).result["sections"][0], "battery_energy_Wh");
    };
    CHECK(drive(true) == Approx(drive(false)).epsilon(1e-4));
  }
}

TEST_CASE("other consumers take their power for as long as a section lasts, and efficiencies act one way each",
          "[fast]") {
  const auto drive = [](double efficiency, double regeneration, double auxiliary_W) {
    scenarios::RunSpec spec = make_j1634();
    spec.vehicle->powertrain.efficiency = efficiency;
    spec.vehicle->powertrain.regeneration_efficiency = regeneration;
    spec.vehicle->powertrain.auxiliary_power_W = auxiliary_W;
    return scenarios::run_scenario(spec, {}).result["sections"];
  };
  const Json plain = drive(0.85, 0.0, 0.0);
  const Json consumers = drive(0.85, 0.0, 400.0);
  const Json lossy_way_back = drive(0.85, 0.5, 0.0);
  const std::vector<double> durations_s{1369.0, 765.0, 1369.0, 300.0, 1369.0, 765.0, 1369.0, 300.0};
  REQUIRE(plain.size() == durations_s.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    INFO(plain[i]["name"]);
    CHECK(number_of(consumers[i], "battery_energy_Wh") - number_of(plain[i], "battery_energy_Wh") ==
          Approx(400.0 * durations_s[i] / 3600.0));
    CHECK(number_of(lossy_way_back[i], "battery_energy_Wh") - number_of(plain[i], "battery_energy_Wh") ==
          Approx((0.85 - 0.5) * number_of(plain[i], "recuperated_Wh")));
  }
}

TEST_CASE("a drive beyond the map of the powertrain is warned of", "[fast]") {
  scenarios::RunSpec spec = tests::make_spec("drive_cycle", "a50", {"cycle=us06"}, "quasi_static");
  spec.vehicle->powertrain.map = make_even_map(0.8);
  const auto list_warnings = [&spec] {
    std::vector<std::string> of_map;
    for (const std::string& warning : scenarios::run_scenario(spec, {}).warnings) {
      if (warning.find("map of the powertrain") != std::string::npos) of_map.push_back(warning);
    }
    return of_map;
  };
  CHECK(list_warnings().empty());
  spec.vehicle->powertrain.map->speeds_m_s = {0.0, 10.0, 30.0};
  spec.vehicle->powertrain.map->powers_W = {-20e3, 0.0, 20e3};
  const std::vector<std::string> warnings = list_warnings();
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0].find("129.2 km/h") != std::string::npos);
  CHECK(warnings[1].find("20.0 kW") != std::string::npos);
}

TEST_CASE("a battery in Wh is doubted by its range", "[fast]") {
  CHECK_FALSE(scenarios::doubt_range(800e3, 100.0 * kWh).has_value());
  CHECK_THAT(*scenarios::doubt_range(500e6, 67198.0 * kWh), Catch::Contains("usable_energy_kWh = 67198 in Wh?"));
}
