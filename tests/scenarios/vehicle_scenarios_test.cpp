// Scenarios with a vehicle: weather, odd vehicles, coasts that do not end, the state in which tires start.
#include <algorithm>
#include <catch2/catch.hpp>

#include "rigs/vehicle_channels.h"
#include "scenarios/common/coastdown_evaluation.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/uneven_machines.h"

using namespace rollrig;

namespace {

using Settings = std::vector<std::string>;

scenarios::Outcome run_on(const std::string& rig, const std::string& scenario, const Settings& settings,
                          const std::string& fidelity = "quasi_static") {
  ConfigTable document = scenarios::make_run_document(scenario);
  set_config_value(document, "tire", "a50", "test");
  set_config_value(document, "rig", rig, "test");
  set_config_value(document, "fidelity", fidelity, "test");
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  const scenarios::RunSpec spec = scenarios::read_run_spec(document, "");
  return scenarios::run_scenario(spec, {});
}

double first_time_s(const scenarios::Outcome& outcome) {
  return outcome.result["coastdowns"][0]["duration_s"].get<double>();
}

}  // namespace

TEST_CASE("the air of the road has the temperature of the run, said by rig or by setting", "[fast]") {
  const Settings cold{"ambient_degC=-20", "warm_up_min=10"};
  const auto by_setting = run_on("road", "coastdown", cold);
  const auto by_rig = run_on("road", "coastdown", {"rig.environment.ambient_degC=-20", "warm_up_min=10"});
  CHECK(by_setting.result == by_rig.result);
  // C at reference conditions is that of the drag area, 1.1672 kg/m3 / 2 x 0.72 m2 = 0.4202 N s2/m2, whatever the
  // weather of the test; what tires add to it is a few percent.
  const double drag_N_per_km_h2 = 0.5 * 98.21e3 / (287.05 * 293.15) * 0.72 / (3.6 * 3.6);
  CHECK(tests::number(by_setting, "C_N_per_km_h2") == Approx(drag_N_per_km_h2).epsilon(0.06));
  CHECK(first_time_s(by_setting) < 0.95 * first_time_s(run_on("road", "coastdown", {"warm_up_min=10"})));
}

TEST_CASE("a coastdown in air that the standard does not test in is warned of", "[fast]") {
  const auto count_warnings = [](const std::string& ambient) {
    const auto outcome = run_on("road", "coastdown", {"ambient_degC=" + ambient, "warm_up_min=10"});
    return std::count_if(outcome.warnings.begin(), outcome.warnings.end(),
                         [](const std::string& warning) { return warning.find("SAE J2263") != std::string::npos; });
  };
  CHECK(count_warnings("4") == 1);
  CHECK(count_warnings("6") == 0);
  CHECK(count_warnings("34") == 0);
  CHECK(count_warnings("36") == 1);
}

TEST_CASE("a coast that does not end is a failed run that says why", "[fast]") {
  CHECK_THROWS_WITH(run_on("road", "coastdown", {"slope_percent=-1", "warm_up_min=0"}),
                    Catch::Contains("slope_percent"));
}

TEST_CASE("an effective mass below that of the bodies themselves", "[fast]") {
  const Settings light{"effects.inertia_error.error_percent=-4", "warm_up_min=0"};
  const auto multibody = run_on("road", "coastdown", light, "multibody");
  const auto quasi_static = run_on("road", "coastdown", light);
  CHECK(first_time_s(multibody) == Approx(first_time_s(quasi_static)).margin(0.1));
  // Less to slow down by the same forces: 4 % less time, nearly.
  const double usual_s = first_time_s(run_on("road", "coastdown", {"warm_up_min=0"}));
  CHECK(first_time_s(multibody) == Approx(0.96 * usual_s).epsilon(0.005));
}

TEST_CASE("keeping pace costs the rollers no energy, however the axles are loaded", "[fast]") {
  for (const char* driven : {"front", "rear", "all"}) {
    INFO(driven);
    const Settings uneven{"vehicle.geometry.front_load_share=0.7",
                          std::string("vehicle.powertrain.driven_axle=") + driven, "warm_up_min=5"};
    const auto multibody = run_on("dyno_1m2", "coastdown", uneven, "multibody");
    const auto quasi_static = run_on("dyno_1m2", "coastdown", uneven);
    CHECK(first_time_s(multibody) == Approx(first_time_s(quasi_static)).margin(0.1));
    CHECK(multibody.recording.audit.find_term_J(sim::kMotorWork) ==
          Approx(quasi_static.recording.audit.find_term_J(sim::kMotorWork)).epsilon(1e-3));
  }
}

TEST_CASE("the work of a driver who takes over at another speed is in the audit", "[fast]") {
  const auto outcome = run_on("road", "coastdown", {"warm_up_min=0", "to_km_h=60"});
  CHECK_NOTHROW(outcome.recording.audit.require_closed(1e-9));
}

TEST_CASE("a drive cycle is integrated by a one-step method, a coastdown by a multistep method", "[fast]") {
  const auto cycle = run_on("dyno_1m2", "drive_cycle", {"cycle=us06", "wheels=1"}, "multibody");
  CHECK(cycle.statistics["method"] == "ROS34PW2");
  CHECK(cycle.statistics["jacobian_evaluations"] < cycle.statistics["steps"].get<int>() / 5);
  CHECK(run_on("road", "coastdown", {}, "multibody").statistics["method"] == "CVODES BDF");
}

TEST_CASE("the tables of a multi-cycle test end with the whole test", "[fast]") {
  const auto outcome = run_on("dyno_1m2", "sae_j1634", {"wheels=1", "variant=source", "mid_min=5", "end_min=5"});
  const std::vector<Table>& tables = outcome.sheet.tables;
  REQUIRE(tables.size() == 2);
  const auto sum_of = [](const Table& table, std::size_t column) {
    double sum = 0.0;
    for (std::size_t row = 0; row + 1 < table.rows.size(); ++row) sum += std::stod(table.rows[row][column]);
    return sum;
  };
  for (const Table& table : tables) {
    REQUIRE(table.rows.size() == outcome.result["sections"].size() + 1);
    CHECK(table.rows.back().front() == "all sections");
  }
  // Each row is rounded by itself: half a digit for each of the eight sections and the sum.
  const Table& tire = tables[0];
  CHECK(std::stod(tire.rows.back()[1]) == Approx(sum_of(tire, 1)).margin(9 * 0.005));
  CHECK(std::stod(tire.rows.back()[2]) == Approx(sum_of(tire, 2)).margin(9 * 0.05));
  CHECK(std::stod(tire.rows.back()[3]) == Approx(sum_of(tire, 3)).margin(9 * 0.05));
  CHECK(std::stod(tire.rows.back()[4]) ==
        Approx(100.0 * (sum_of(tire, 2) / sum_of(tire, 3) - 1.0)).margin(0.05 + 100.0 * 0.9 / sum_of(tire, 3)));
  const Table& vehicle = tables[1];
  for (const std::size_t column : {3U, 4U, 5U}) {
    CHECK(std::stod(vehicle.rows.back()[column]) == Approx(sum_of(vehicle, column)).margin(9 * 0.5));
  }
}

TEST_CASE("recuperation saves the battery what the hubs take in, less what the powertrain keeps of it", "[fast]") {
  const auto drive = [](double efficiency, double regeneration_limit_m_s2) {
    scenarios::RunSpec spec =
        tests::make_spec("sae_j1634", "a50", {"wheels=1", "variant=source", "mid_min=5", "end_min=5"}, "quasi_static");
    spec.rig = tests::make_uneven_dyno();
    spec.vehicle = tests::make_uneven_vehicle();
    spec.vehicle->powertrain.efficiency = efficiency;
    spec.vehicle->powertrain.regeneration_limit_m_s2 = regeneration_limit_m_s2;
    return scenarios::run_scenario(spec, {}).result["sections"];
  };
  constexpr double kEfficiency = 0.7;
  const Json without = drive(kEfficiency, 0.0);
  const Json with = drive(kEfficiency, 1.5);
  const Json lossless = drive(1.0, 1.5);
  const auto at = [](const Json& section, const char* key) { return section[key].get<double>(); };
  for (std::size_t i = 0; i < with.size(); ++i) {
    INFO(with[i]["name"].get<std::string>());
    const double hubs_Wh = at(with[i], "wheel_energy_Wh");
    const double taken_in_Wh = at(with[i], "recuperated_Wh");
    CHECK(taken_in_Wh > 0.0);
    CHECK(at(without[i], "recuperated_Wh") == 0.0);
    CHECK(kEfficiency * at(without[i], "battery_energy_Wh") == Approx(at(without[i], "wheel_energy_Wh")));
    const double saved_Wh = at(without[i], "battery_energy_Wh") - at(with[i], "battery_energy_Wh");
    CHECK(saved_Wh == Approx(kEfficiency * taken_in_Wh).margin(1e-4 * hubs_Wh));
    CHECK(at(lossless[i], "battery_energy_Wh") == Approx(hubs_Wh - taken_in_Wh));
  }
}

TEST_CASE("flat spots are rolled out where the tire comes from another run", "[fast]") {
  const Settings cycle{"wheels=1", "variant=source", "mid_min=5", "end_min=5"};
  const auto with = [&cycle](const Settings& more) {
    Settings all = cycle;
    all.insert(all.end(), more.begin(), more.end());
    return run_on("dyno_1m2", "sae_j1634", all).result["sections"][0]["rr_energy_Wh"].get<double>();
  };
  const double without = with({});
  const double soaked = with({"effects.flat_spot.excess_percent=8"});
  CHECK(soaked > 1.01 * without);
  CHECK(with({"effects.flat_spot.excess_percent=8", "tire_state=warm"}) < soaked);
  const double after_an_hour = with({"effects.flat_spot.excess_percent=8", "rest_before_min=60"});
  CHECK(after_an_hour > without);
  CHECK(after_an_hour < soaked);
}

TEST_CASE("warm rollers change the force that is set, not the coastdown on the road that it is to meet", "[fast]") {
  const auto set_on = [](const char* surface) {
    return run_on("dyno_1m2", "dyno_setting", {"wheels=1", "warm_up_min=2", "to_km_h=100", "iterations=1", surface})
        .result;
  };
  const Json cool = set_on("surface_temperature_degC=15");
  const Json warm = set_on("surface_temperature_degC=45");
  CHECK(warm["target_A_N"] == cool["target_A_N"]);
  CHECK(warm["set_A_N"] != cool["set_A_N"]);
}

TEST_CASE("a setting from coastdowns that begin below its highest speed says that it extrapolates", "[fast]") {
  const auto set = [](const char* from) {
    return run_on("dyno_1m2", "dyno_setting", {"wheels=1", "warm_up_min=2", "iterations=1", from}).warnings;
  };
  const auto says = [](const std::vector<std::string>& warnings) {
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("are extrapolated, up to 130 km/h") != std::string::npos;
    });
  };
  CHECK(says(set("from_km_h=60")));
  CHECK_FALSE(says(set("from_km_h=130")));
}

TEST_CASE("rollers under a vehicle that is given by its road load leave its tires their loss", "[fast]") {
  auto spec = tests::make_spec("dyno_setting", "a50");
  spec.vehicle->road_load = models::RoadLoad<double>{150.0, 1.0, 0.4};
  const auto set = scenarios::VehicleConditions::find_default_set_load(spec);
  // The file's coefficient lacks the loss at the 200 N of its skim test, under 1 % of that at 6865 N.
  CHECK(set.A_N < 150.0 - 5.2e-3 * 4.0 * 5400.0);
  CHECK(set.A_N > 150.0 - 1.01 * 5.2e-3 * 4.0 * 5400.0);
  CHECK(set.B_N_s_per_m == 1.0);
  CHECK(set.C_N_s2_per_m2 == 0.4);
}

TEST_CASE("an effect on measured channels finds those of each wheel under their own names", "[fast]") {
  const auto spec = tests::make_spec("dyno_setting", "a50");
  const auto layout = rigs::make_whole_vehicle(*spec.vehicle, spec.rig, 293.15, {});
  const Quantity of_rear_left = intern_quantity("liner_temperature_rear_left_degC");
  CHECK(rigs::find_at_wheel(of_rear_left, layout, 2) == models::quantities::kLinerTemperature);
  CHECK_FALSE(rigs::find_at_wheel(of_rear_left, layout, 0).has_value());
  CHECK(rigs::find_at_wheel(models::quantities::kTractionForce, layout, 0) == models::quantities::kTractionForce);
  CHECK_FALSE(rigs::find_at_wheel(models::quantities::kTractionForce, layout, 1).has_value());
  const auto quarter = rigs::make_one_wheel(*spec.vehicle, spec.rig, 293.15, {}, tests::kFront);
  CHECK(rigs::find_at_wheel(models::quantities::kCavityPressure, quarter, 0) == models::quantities::kCavityPressure);
}

TEST_CASE("a vehicle that would bounce through the whole test is refused on the multibody rig", "[fast]") {
  ConfigTable document = scenarios::make_run_document("coastdown");
  set_config_value(document, "tire", "a50", "test");
  scenarios::RunSpec spec = scenarios::read_run_spec(document, "");
  const auto prepare = [&spec](double damping_N_s_per_m, scenarios::Fidelity fidelity) {
    spec.fidelity = fidelity;
    spec.vehicle->axles[1].suspension.damping_N_s_per_m = damping_N_s_per_m;
    scenarios::prepare_run(spec);
  };
  CHECK_THROWS_WITH(prepare(10.0, scenarios::Fidelity::kMultibody),
                    Catch::Contains("axle 'rear'") && Catch::Contains("damping_N_s_per_m") && Catch::Contains("10") &&
                        Catch::Contains("at least"));
  CHECK_NOTHROW(prepare(10.0, scenarios::Fidelity::kQuasiStatic));
  CHECK_NOTHROW(prepare(1000.0, scenarios::Fidelity::kMultibody));
}
