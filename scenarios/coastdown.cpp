/// Coastdown of a vehicle on the road or on a dynamometer, both directions, and its A, B, C.
#include "scenarios/common/coastdown_evaluation.h"
#include "scenarios/common/vehicle_bench.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  VehicleConditions conditions;
  Coastdowns coastdowns;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    VehicleConditions::visit(p.conditions, visit);
    Coastdowns::visit(p.coastdowns, visit);
  }
};

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  VehicleProgram program(settings.conditions, spec.sample_interval_s, 0.0);
  settings.coastdowns.check(spec);
  settings.coastdowns.append_to(program);
  return program;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const estimation::CoastdownData data =
      collect_coastdowns(outcome.recording, spec, settings.conditions, settings.coastdowns);
  const estimation::RoadLoadFit fit = fit_vehicle_coastdowns(data, spec);
  outcome.result = road_load_to_json(fit);
  outcome.result["coastdowns"] = Json::array();
  for (const sim::PhaseSpan& phase : outcome.recording.phases) {
    if (!is_coastdown(phase.name)) continue;
    outcome.result["coastdowns"].push_back({{"name", phase.name}, {"duration_s", phase.end_s - phase.start_s}});
    outcome.lines.push_back({phase.name, fmt::format("{:.2f} s", phase.end_s - phase.start_s)});
  }
  add_road_load_lines(spec, fit, outcome);
  for (const std::string& warning : fit.warnings) outcome.warnings.push_back(warning);
}

}  // namespace

const Scenario& scenario_coastdown() {
  static const Scenario scenario = make_vehicle_scenario<Settings>(
      {"coastdown",
       "Coastdowns of a vehicle on the road or on a dynamometer, and A, B, C from them",
       "Warm-up at constant speed, then pairs of coastdowns in both directions in neutral from 130 km/h to standstill. "
       "Slope and wind of the road, where given, turn round with the direction. A, B, C by generalized least squares "
       "on force against speed, at reference conditions (20 degC, 98.21 kPa, still air).",
       "source §3.4.1, §3.4.3, (3.20); SAE J2263",
       {{"A_N", "with A_N_sd"},
        {"B_N_per_km_h", "with B_N_per_km_h_sd"},
        {"C_N_per_km_h2", "with C_N_per_km_h2_sd"},
        {"force_N", "at speeds of 20 to 130 km/h"},
        {"coastdowns", "of each: name, duration_s"}}},
      {rigs::RigKind::kFlat, rigs::RigKind::kDyno}, "flat", &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
