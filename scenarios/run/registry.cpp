#include <algorithm>

#include "scenarios/run/run_spec.h"
#include "scenarios/run/scenario.h"
#include "sim/core/error.h"

namespace rollrig::scenarios {

// Named one by one, since the linker drops objects of a static library that nothing refers to.
#define ROLLRIG_SCENARIO(name) \
  namespace name {             \
  Scenario make();             \
  }
#include "scenarios/scenarios.def"
#undef ROLLRIG_SCENARIO

namespace {

void warn_of_conductances(const RunSpec& spec, Outcome& outcome) {
  if (spec.baseline == models::Baseline::kConstantRrc) return;
  const auto warn = [&](const models::TireFile& tire) {
    const auto warning = tire.warn_of_conductances(spec.rig.cooling_rig());
    if (warning.has_value()) outcome.warnings.push_back(*warning);
  };
  if (!spec.vehicle.has_value()) return warn(spec.tire);
  for (const rigs::VehicleAxle& axle : spec.vehicle->axles) {
    if (axle.tire.has_value()) warn(*axle.tire);
  }
  const auto has_own = [](const rigs::VehicleAxle& axle) { return axle.tire.has_value(); };
  if (!std::all_of(spec.vehicle->axles.begin(), spec.vehicle->axles.end(), has_own)) warn(spec.tire);
}

}  // namespace

PreparedRun prepare_run(const RunSpec& spec) {
  return [&spec, run = spec.scenario->prepare(spec)](const sim::Progress& progress) {
    try {
      Outcome outcome = run(progress);
      warn_of_conductances(spec, outcome);
      return outcome;
    } catch (const RunFailure& failure) {
      if (spec.effects.empty()) throw;
      throw RunFailure(std::string(failure.what()) + "\neffects that were on: " + describe_effects(spec.effects));
    }
  };
}

Outcome run_scenario(const RunSpec& spec, const sim::Progress& progress) { return prepare_run(spec)(progress); }

const std::vector<const Scenario*>& all_scenarios() {
  static const std::vector<Scenario> scenarios{
#define ROLLRIG_SCENARIO(name) name::make(),
#include "scenarios/scenarios.def"
#undef ROLLRIG_SCENARIO
  };
  static const std::vector<const Scenario*> pointers = [] {
    std::vector<const Scenario*> all;
    for (const Scenario& scenario : scenarios) all.push_back(&scenario);
    return all;
  }();
  return pointers;
}

std::vector<std::string> scenario_names() {
  std::vector<std::string> names;
  for (const Scenario* scenario : all_scenarios()) names.push_back(scenario->text.name);
  return names;
}

const Scenario* find_scenario_if_any(const std::string& name) {
  for (const Scenario* scenario : all_scenarios()) {
    if (name == scenario->text.name || (!name.empty() && name == scenario->text.former_name)) return scenario;
  }
  return nullptr;
}

const Scenario& find_scenario(const std::string& name) {
  if (const Scenario* scenario = find_scenario_if_any(name)) return *scenario;
  throw InputError(unknown_name("scenario", name, scenario_names()));
}

}  // namespace rollrig::scenarios
