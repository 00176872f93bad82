/// One drive cycle on rollers or on the road, once or several times in a row.

#include <fmt/format.h>

#include <numeric>

#include "scenarios/common/drive_sections.h"
#include "scenarios/common/energy_uncertainty.h"
#include "scenarios/common/multi_cycle_energy.h"

namespace rollrig::scenarios::drive_cycle {

struct Settings {
  VehicleConditions conditions;
  Name cycle{"wltc_class3b"};
  int repetitions = 0;
  double pause_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    VehicleConditions::visit(p.conditions, visit);
    visit(Field{"cycle", any_number(), "Name of a cycle (rollrig list cycles), or path of a file with its columns"},
          p.cycle);
    visit(Field{"repetitions", between(1.0, 100.0), "How often it is driven", 1.0}, p.repetitions);
    visit(Field{"pause_min", between(0.0, 600.0), "Standstill between two cycles, vehicle off", 0.0}, p.pause_s);
  }

  void complete(const RunSpec& spec) { conditions.complete(spec); }
};

struct Results {
  std::string wheels;
  std::string cycle;
  std::vector<DriveSection> sections;
  std::optional<DriveSection> total;
  std::optional<double> consumption_J_per_m;
  std::optional<double> usable_J;
  std::optional<double> range_m;
  std::optional<double> ac_J_per_m;

  void visit(ResultSheet& visit) const {
    const auto invert = [](const std::optional<double>& value) {
      return value.has_value() && *value > 0.0 ? std::optional(1.0 / *value) : std::nullopt;
    };
    visit(Remark{"Wheels simulated"}, wheels);
    visit(Result{"cycle", "Cycle", "", "its name"}, cycle);
    visit(Result{"consumption_Wh_per_km", "Consumption, DC", ".1f",
                 "out of the battery; of several cycles by the weights of SAE J1634 where [battery] is given, else the "
                 "mean"},
          consumption_J_per_m);
    visit(Result{"consumption_mi_per_kWh", "  as distance", ".2f", "the same, as distance over energy"},
          invert(consumption_J_per_m));
    visit(Result{"usable_energy_kWh", "Usable battery energy", ".3f",
                 "of [battery]; left out without it, as are range and AC consumption"}
              .or_left_out(),
          usable_J);
    visit(Result{"range_km", "Range", ".1f", "usable energy over consumption"}.or_left_out(), range_m);
    visit(Result{"ac_consumption_Wh_per_km", "Consumption, AC", ".1f", "recharge energy over range"}.or_left_out(),
          ac_J_per_m);
    visit(ResultList{"sections", "Rolling resistance of one tire, by model and by ISO coefficient; of all tires",
                     "each cycle", "Liner of that tire; energy of the whole vehicle, at its hubs and its battery"},
          sections, total);
    visit(Summary{
        "The vehicle takes {consumption_Wh_per_km} out of the battery in {cycle}, for a range of {range_km}. Its tires "
        "lose {sections.first.vehicle_rr_energy_Wh} over {sections.first.distance_km}."});
    visit(
        Summary{"The vehicle takes {consumption_Wh_per_km} out of the battery in {cycle}. Its tires lose "
                "{sections.first.vehicle_rr_energy_Wh} over {sections.first.distance_km}."});
    visit(Summary{"The vehicle takes {consumption_Wh_per_km} out of the battery in {cycle}."});
    visit(Headline{"Consumption", "{consumption_Wh_per_km}", "out of the battery, {cycle}"});
    visit(Headline{"Range", "{range_km}"});
    visit(Headline{"Model above the ISO coefficient", "{sections.first.difference_percent}",
                   "rolling resistance of one tire in {sections.first.name}"});
    visit(Headline{"Lost by the tires", "{sections.first.vehicle_rr_energy_Wh}",
                   "{sections.first.name}, {sections.first.distance_km}"});
  }
};

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  const SpeedTrace trace = read_speed_trace(settings.cycle.value);
  VehicleProgram program(settings.conditions, spec.sample_interval_s, 0.0);
  program.start_at(trace.speed_m_s.front());
  for (int n = 1; n <= settings.repetitions; ++n) {
    if (n > 1) program.rest(fmt::format("pause {}", n - 1), settings.pause_s);
    program.drive(trace, fmt::format("cycle {}", n));
  }
  return program;
}

/// Of the cycles together; with a battery that holds more than one of them, as a range is found from it.
void find_economy(const RunSpec& spec, Results& results) {
  std::vector<EnergySection> cycles;
  for (const DriveSection& section : results.sections) cycles.push_back({section.battery_J, section.distance_m});
  const std::vector<double> equal(cycles.size(), 1.0 / static_cast<double>(cycles.size()));
  if (!spec.vehicle->battery.has_value()) {
    results.consumption_J_per_m = calc_economy(cycles, equal, {}).dc_J_per_m;
    return;
  }
  const rigs::VehicleBattery& battery = *spec.vehicle->battery;
  const double all_J = results.total->battery_J;
  if (all_J > battery.usable_J) {
    throw InputError({fmt::format("the battery of vehicle '{}' is empty before the last cycle ends: the cycles take "
                                  "{:.2f} kWh",
                                  spec.vehicle->name, all_J / 3.6e6),
                      spec.vehicle->path, 0, "usable_energy_kWh", fmt::format("{:g}", battery.usable_J / 3.6e6),
                      fmt::format("at least {:.2f}, or fewer repetitions", all_J / 3.6e6), ""});
  }
  const BatteryCharge charge{battery.usable_J, battery.calc_recharge_J()};
  const CycleEconomy economy =
      calc_economy(cycles, cycles.size() > 1 ? calc_phase_weights(cycles, charge.usable_J) : equal, charge);
  results.consumption_J_per_m = economy.dc_J_per_m;
  results.usable_J = charge.usable_J;
  results.range_m = economy.range_m;
  results.ac_J_per_m = economy.ac_J_per_m;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const rigs::VehicleLayout layout = settings.conditions.make_layout(spec);
  Results results;
  results.wheels = describe_wheels(settings.conditions, layout);
  const SpeedTrace trace = read_speed_trace(settings.cycle.value);
  results.cycle = trace.name;
  for (std::string& doubt : doubt_trace(trace)) outcome.warnings.push_back(std::move(doubt));
  for (std::size_t i = 0; i < outcome.recording.phases.size(); ++i) {
    if (outcome.recording.phases[i].name.rfind("cycle", 0) != 0) continue;
    results.sections.push_back(evaluate_section(spec, layout, outcome.recording, i));
  }
  results.total = add_up(results.sections);
  find_economy(spec, results);
  if (results.range_m.has_value()) {
    const rigs::VehicleBattery& battery = *spec.vehicle->battery;
    if (const auto doubt = doubt_charge(battery.usable_J, battery.calc_recharge_J())) {
      outcome.warnings.push_back(*doubt);
    }
    if (const auto doubt = doubt_range(*results.range_m, *results.usable_J)) outcome.warnings.push_back(*doubt);
  }
  warn_of_map(spec, layout, outcome);
  warn_of_unused_tire(spec, outcome);
  std::vector<ReportedCycle> cycles;
  if (results.consumption_J_per_m.has_value()) {
    cycles.push_back({"", "", Json::json_pointer(), "consumption_Wh_per_km", results.range_m.has_value()});
  }
  outcome.make_measurement_model = [&spec, used = outcome.settings, cycles] {
    return make_section_energy_model(spec, used, cycles);
  };
  return results;
}

Scenario make() {
  Scenario scenario = make_vehicle_scenario(
      {"drive_cycle", "One drive cycle, such as WLTC or US06, once or several times, with consumption and range",
       "From soaked tires, the cycle as often as asked for, with a pause between two. Of each cycle, for one tire: "
       "energy of rolling resistance by the model and by the constant ISO coefficient, temperatures, mean coefficient; "
       "for the vehicle: energy at the hubs and out of the battery. With [battery] in the vehicle's file also the "
       "range; several cycles are weighted as the city cycles of SAE J1634, the first by its share of the usable "
       "energy. On rig road a vehicle with [road_load] needs exactly that at the wheels.",
       "formats.md: drive cycles; phase scaling: docs/j1634.md"},
      "dyno_1m2", &plan, &evaluate);
  scenario.has_uncertainty = true;
  return scenario;
}

}  // namespace rollrig::scenarios::drive_cycle
