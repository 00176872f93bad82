// The uncertainty of the energies of a multi-cycle test against simulations.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/uncertainty/uncertainty.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

double add_up(const Json& result, const char* key) {
  double sum = 0.0;
  for (const Json& section : result["sections"]) sum += section[key].get<double>();
  return sum;
}

}  // namespace

TEST_CASE("the energies of the budget are those of the result, and move as in simulations", "[slow]") {
  const std::vector<std::string> settings{"mid_min=5", "end_min=5"};
  const scenarios::RunSpec spec = tests::make_spec("sae_j1634", "a50", settings, "quasi_static");
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const MeasurementModel model = outcome.make_measurement_model();
  std::vector<double> x;
  for (const UncertainInput& input : model.inputs) x.push_back(input.value);
  const std::vector<double> now = model.evaluate(x);
  CHECK(now[0] / 3600.0 == Approx(add_up(outcome.result, "battery_energy_Wh")).epsilon(1e-9));
  CHECK(now[1] / 3600.0 == Approx(add_up(outcome.result, "vehicle_rr_energy_Wh")).epsilon(1e-9));
  REQUIRE(model.measurands.size() == 2 + 2 * 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& cycle = outcome.result["economy"][i];
    INFO(cycle["name"]);
    CHECK(model.measurands[2 + 2 * i].key == cycle["name"].get<std::string>() + "_dc_consumption_Wh_per_km");
    CHECK(now[2 + 2 * i] / 3.6 == Approx(cycle["dc_consumption_Wh_per_km"].get<double>()).epsilon(1e-9));
    CHECK(now[3 + 2 * i] / 1e3 == Approx(cycle["range_km"].get<double>()).epsilon(1e-9));
  }
  // The sections give the usable energy here, by the same meter: its gain has no part in a range.
  std::vector<double> gained = x;
  gained[0] = 1.01;
  const std::vector<double> read = model.evaluate(gained);
  CHECK(read[6] == Approx(1.01 * now[6]));
  CHECK(read[7] == Approx(now[7]));
  scenarios::RunSpec with_battery = tests::make_spec("sae_j1634", "a50", {"mid_min=5", "end_min=5"}, "quasi_static");
  with_battery.vehicle->battery = rigs::VehicleBattery{};
  with_battery.vehicle->battery->usable_J = 60.0 * 3.6e6;
  with_battery.vehicle->battery->charging_efficiency = 0.9;
  const MeasurementModel given = scenarios::run_scenario(with_battery, {}).make_measurement_model();
  // With a battery each cycle has a third measurand, consumption of alternating current, and the recharge a meter.
  REQUIRE(given.measurands.size() == 2 + 3 * 3);
  CHECK(given.measurands[10].key == "combined_ac_consumption_Wh_per_km");
  x.push_back(1.0);
  gained.push_back(1.0);
  const std::vector<double> range = given.evaluate(x);
  CHECK(range[10] / 3.6 ==
        Approx(scenarios::run_scenario(with_battery, {}).result["economy"][2]["ac_consumption_Wh_per_km"].get<double>())
            .epsilon(1e-9));
  CHECK(given.evaluate(gained)[9] == Approx(range[9] / 1.01));    // a meter that reads high makes the range short
  CHECK(given.evaluate(gained)[10] == Approx(range[10] * 1.01));  // and the same recharge lasts for fewer km
  gained.back() = 1.02;
  CHECK(given.evaluate(gained)[10] == Approx(range[10] * 1.01 * 1.02));
  CHECK(given.evaluate(gained)[9] == Approx(range[9] / 1.01));
  x.pop_back();
  // Heavier, warmer: off the point, as --set has it.
  std::vector<std::string> others = settings;
  others.insert(others.end(), {"ambient_degC=27", "vehicle.mass_kg=2250"});
  const scenarios::Outcome other =
      scenarios::run_scenario(tests::make_spec("sae_j1634", "a50", others, "quasi_static"), {});
  x[1] = 2250.0;
  x[2] = 300.15;
  const std::vector<double> moved = model.evaluate(x);
  CHECK(moved[1] / 3600.0 == Approx(add_up(other.result, "vehicle_rr_energy_Wh")).epsilon(1e-9));
  CHECK(std::abs(moved[1] / now[1] - 1.0) > 0.005);
  CHECK(moved[7] / 1e3 == Approx(other.result["economy"][2]["range_km"].get<double>()).epsilon(1e-9));
}

TEST_CASE("consumption and range of a drive cycle have a budget, and move as in simulations", "[fast]") {
  const std::vector<std::string> settings{"cycle=udds", "repetitions=2"};
  scenarios::RunSpec spec = tests::make_spec("drive_cycle", "a50", settings, "quasi_static");
  const MeasurementModel plain = scenarios::run_scenario(spec, {}).make_measurement_model();
  REQUIRE(plain.measurands.size() == 3);  // no range without a battery
  CHECK(plain.measurands[2].key == "consumption_Wh_per_km");
  spec.vehicle->battery = rigs::VehicleBattery{};
  spec.vehicle->battery->usable_J = 60.0 * 3.6e6;
  spec.vehicle->battery->charging_efficiency = 0.9;
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  const MeasurementModel model = outcome.make_measurement_model();
  REQUIRE(model.measurands.size() == 5);
  CHECK(model.measurands[3].key == "range_km");
  CHECK(model.measurands[4].key == "ac_consumption_Wh_per_km");
  std::vector<double> x;
  for (const UncertainInput& input : model.inputs) x.push_back(input.value);
  const std::vector<double> now = model.evaluate(x);
  CHECK(now[2] / 3.6 == Approx(outcome.result["consumption_Wh_per_km"].get<double>()).epsilon(1e-9));
  CHECK(now[3] / 1e3 == Approx(outcome.result["range_km"].get<double>()).epsilon(1e-9));
  CHECK(now[4] / 3.6 == Approx(outcome.result["ac_consumption_Wh_per_km"].get<double>()).epsilon(1e-9));
  // The usable energy is the file's: a meter that reads 1 % high makes the range short.
  x[0] = 1.01;
  CHECK(model.evaluate(x)[3] == Approx(now[3] / 1.01));
  x[0] = 1.0;
  x[1] = 2250.0;
  spec.vehicle->body.mass_kg = 2250.0;
  const Json heavy = scenarios::run_scenario(spec, {}).result;
  CHECK(model.evaluate(x)[3] / 1e3 == Approx(heavy["range_km"].get<double>()).epsilon(1e-9));
  CHECK(model.evaluate(x)[3] < 0.995 * now[3]);
}

TEST_CASE("the numbers of a tire file move together by their correlation", "[slow]") {
  // Two numbers of the loss with correlation 0.58: the variance of the energy is c R c, and not the sum of squares.
  const std::vector<std::string> settings{"mid_min=5", "end_min=5"};
  scenarios::RunSpec spec = tests::make_spec("sae_j1634", "a50", settings, "quasi_static");
  models::TireParameters<double>::visit_all(spec.tire.standard_uncertainties,
                                            [](const std::string& table, const Field& field, double& sd) {
                                              const std::string key = table + "." + field.key;
                                              if (key != "bounded.loss_N" && key != "bounded.speed_rise") sd = 0.0;
                                            });
  REQUIRE(spec.tire.correlation.matrix[0][1] == 0.58);
  const auto contribution = [](const scenarios::RunSpec& own) {
    const MeasurementModel model = scenarios::run_scenario(own, {}).make_measurement_model();
    REQUIRE(model.inputs.size() == 6);
    return calc_budgets(model)[1].contributions.back().contribution;
  };
  const double together = contribution(spec);
  const auto alone = [&](const std::string& kept) {
    scenarios::RunSpec own = spec;
    models::TireParameters<double>::visit_all(own.tire.standard_uncertainties,
                                              [&](const std::string& table, const Field& field, double& sd) {
                                                if (table + "." + field.key != kept) sd = 0.0;
                                              });
    const MeasurementModel model = scenarios::run_scenario(own, {}).make_measurement_model();
    REQUIRE(model.inputs.size() == 5);
    return calc_budgets(model)[1].contributions.back().contribution;
  };
  const double loss = alone("bounded.loss_N");
  const double rise = alone("bounded.speed_rise");
  const double squares = loss * loss + rise * rise;
  // Below the reference speed a larger rise lowers the loss, so that the sign of the second sensitivity is that of the
  // drive: the magnitude of the mixed term is what the correlation says.
  CHECK(std::abs(together * together - squares) == Approx(2 * 0.58 * loss * rise).epsilon(0.02));
}
