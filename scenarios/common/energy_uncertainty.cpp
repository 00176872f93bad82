#include "scenarios/common/energy_uncertainty.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>

#include "estimation/uncertainty/common_inputs.h"
#include "scenarios/common/tire_numbers.h"
#include "scenarios/run/run_spec.h"
#include "scenarios/run/tire_validity.h"

namespace rollrig::scenarios {
namespace {

using estimation::make_assumed_input;
using estimation::MeasurementModel;
using estimation::UncertainInput;

// Half-widths of rectangular distributions; no file says anything of these instruments.
constexpr double kMeterGainLimit = 0.01;       // Assumed: a power analyzer with its current clamps
constexpr double kRechargeGainLimit = 0.005;   // Assumed: a calibrated meter of alternating current, class 0.5
constexpr double kTestMassLimit = 0.002;       // Assumed: a vehicle scale
constexpr double kTestAmbientLimit_K = 1.0;    // Assumed: the air of the cell, at the tires
constexpr double kTestPressureLimit_Pa = 3e3;  // Assumed: a pressure gauge of a workshop

/// Places of the inputs; the numbers of the tire follow, and last, where there is a battery, the meter of the recharge.
namespace energy_input {
enum : std::size_t { kMeter, kMass, kAmbient, kPressure, kTire };
}

void set_number(RunSpec& spec, const std::string& key, double value_SI) {
  set_config_value(spec.settings, key, fmt::format("{:.17g}", unit_of_key(key).from_si(value_SI)), "uncertainty");
}

/// What is measured in a test with sections, SI.
struct MeasuredEnergies {
  bool is_usable_given = false;  // by the vehicle file, and not by the meter
  double battery_J = 0.0;        // of all sections
  double rolling_J = 0.0;        // of all tires and sections
  struct Cycle {
    double consumption_J_per_m = 0.0;
    double range_m = 0.0;
    double recharge_J_per_m = 0.0;  // alternating current; 0 without a battery
  };
  std::vector<Cycle> cycles;  // none in a test of another order than that of SAE J1634
};

double find_SI(const Json& of, const char* key) { return unit_of_key(key).to_si(of[key].get<double>()); }

MeasuredEnergies find_energies(const Json& result, const std::vector<ReportedCycle>& cycles) {
  MeasuredEnergies found;
  found.is_usable_given = result.value("usable_energy_from", "battery") == "battery";
  for (const Json& section : result["sections"]) {
    found.battery_J += find_SI(section, "battery_energy_Wh");
    found.rolling_J += find_SI(section, "vehicle_rr_energy_Wh");
  }
  for (const ReportedCycle& reported : cycles) {
    const Json& cycle = result.at(reported.place);
    const char* const recharge = "ac_consumption_Wh_per_km";
    const bool has_recharge = cycle.contains(recharge) && !cycle[recharge].is_null();
    found.cycles.push_back({find_SI(cycle, reported.consumption_key.c_str()),
                            reported.has_range ? find_SI(cycle, "range_km") : 0.0,
                            has_recharge ? find_SI(cycle, recharge) : 0.0});
  }
  return found;
}

/// The measurands of consumption and range of a cycle. With a battery, the recharge is one of them.
void add_cycle(const ReportedCycle& cycle, bool has_battery, std::vector<estimation::Measurand>& measurands) {
  const std::string of_cycle = cycle.name.empty() ? "" : ", " + cycle.name;
  const auto add = [&](const std::string& name, const std::string& key) {
    measurands.push_back({name, cycle.key_prefix + key});
  };
  add(fmt::format("consumption{}, direct current", of_cycle), cycle.consumption_key);
  if (cycle.has_range) add("range" + of_cycle, "range_km");
  if (has_battery) add(fmt::format("consumption{}, alternating current", of_cycle), "ac_consumption_Wh_per_km");
}

/// The values of the same measurands, as the meters read them.
void add_cycle_values(const MeasuredEnergies& energies, std::size_t place, const ReportedCycle& reported, double meter,
                      std::optional<double> recharge_meter, std::vector<double>& values) {
  const MeasuredEnergies::Cycle& cycle = energies.cycles[place];
  values.push_back(meter * cycle.consumption_J_per_m);
  if (reported.has_range) values.push_back(energies.is_usable_given ? cycle.range_m / meter : cycle.range_m);
  if (recharge_meter.has_value()) values.push_back(*recharge_meter * meter * cycle.recharge_J_per_m);
}

}  // namespace

MeasurementModel make_section_energy_model(const RunSpec& spec, const Json& settings,
                                           const std::vector<ReportedCycle>& cycles) {
  MeasurementModel model;
  model.measurands = {{"energy of the battery, all sections", "battery_energy_Wh"}};
  if (has_tire_loss(spec)) {
    model.measurands.push_back({"energy of rolling resistance, all tires and sections", "vehicle_rr_energy_Wh"});
  }
  const bool has_battery = spec.vehicle->battery.has_value();
  for (const ReportedCycle& cycle : cycles) add_cycle(cycle, has_battery, model.measurands);
  const auto setting = [&settings](const char* key) { return unit_of_key(key).to_si(settings[key].get<double>()); };
  const double mass_kg = spec.vehicle->body.mass_kg;
  model.inputs = {
      make_assumed_input("gain of the energy meter", "gain_percent", 1.0, kMeterGainLimit, "1 %"),
      make_assumed_input("mass as tested", "mass_kg", mass_kg, kTestMassLimit * mass_kg, "0.2 % of the mass"),
      make_assumed_input("air temperature", "ambient_degC", setting("ambient_degC"), kTestAmbientLimit_K, "1 degC"),
      make_assumed_input("tire pressure, cold", "pressure_kPa", setting("pressure_kPa"), kTestPressureLimit_Pa,
                         "3 kPa")};
  const auto numbers = std::make_shared<const TireNumbers>(TireNumbers::of(spec.tire));
  for (std::size_t i = 0; i < numbers->keys.size(); ++i) {
    UncertainInput input{"numbers of the tire file", "tire", 0.0, 1.0};
    input.source = "standard uncertainties of the tire file, with their correlation";
    model.inputs.push_back(input);
  }
  if (numbers->keys.empty()) model.left_out.push_back("the loss of the tire: its file gives no uncertainty");
  if (has_battery) {
    model.inputs.push_back(
        make_assumed_input("gain of the recharge meter", "gain_percent", 1.0, kRechargeGainLimit, "0.5 %"));
    if (cycles.size() > 1) {
      model.left_out.push_back("MPGe: its relative uncertainty is that of the consumption of alternating current");
      model.left_out.push_back("range on a label: its relative uncertainty is that of the range");
    }
    model.left_out.push_back(
        "usable battery energy and energy of the recharge: they are taken from the vehicle file without an "
        "uncertainty. In a test that measures the usable energy with the same meter, its gain cancels in the ranges");
  }
  model.left_out.push_back("the setting of the dynamometer, the efficiency of the powertrain, how the driver follows");
  model.evaluate = [&spec, numbers, cycles](const std::vector<double>& x) {
    RunSpec own = spec;
    own.fidelity = Fidelity::kQuasiStatic;
    own.sensors.reset();
    own.vehicle->body.mass_kg = x[energy_input::kMass];
    set_number(own, "ambient_degC", x[energy_input::kAmbient]);
    set_number(own, "pressure_kPa", x[energy_input::kPressure]);
    const auto count = static_cast<Eigen::Index>(numbers->keys.size());
    numbers->move(Eigen::Map<const Eigen::VectorXd>(x.data() + energy_input::kTire, count), own.tire);
    const MeasuredEnergies energies = find_energies(run_scenario(own, {}).result, cycles);
    std::vector<double> results{x[energy_input::kMeter] * energies.battery_J};
    if (has_tire_loss(own)) results.push_back(energies.rolling_J);
    const std::optional<double> recharge_meter =
        own.vehicle->battery.has_value() ? std::optional(x.back()) : std::nullopt;
    for (std::size_t i = 0; i < cycles.size(); ++i) {
      add_cycle_values(energies, i, cycles[i], x[energy_input::kMeter], recharge_meter, results);
    }
    return results;
  };
  return model;
}

}  // namespace rollrig::scenarios
