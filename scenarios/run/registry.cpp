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

PreparedRun prepare_run(const RunSpec& spec) {
  return [&spec, run = spec.scenario->prepare(spec)](const sim::Progress& progress) {
    try {
      return run(progress);
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
