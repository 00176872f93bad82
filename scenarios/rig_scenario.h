#pragma once
/// A scenario that is one program on one rig, whichever the rig.

#include "scenarios/settings.h"

namespace rollrig::scenarios {

/// Runs `call`; a run that fails says which effects were on.
template <class Call>
void with_effects_named(const RunSpec& spec, Call&& call) {
  try {
    call();
  } catch (const RunFailure& failure) {
    if (spec.effects.empty()) throw;
    throw RunFailure(std::string(failure.what()) + "\neffects that were on: " + describe_effects(spec.effects));
  }
}

/// Settings (with a member `conditions`) are read and completed, `plan` makes the program, `simulate` runs it,
/// `evaluate` fills result, lines and tables; `check_tire` throws InputError when the tire lacks what the rig takes.
template <class Settings, class Program, class Simulate, class CheckTire>
Scenario make_rig_scenario(ScenarioText text, Program (*plan)(const Settings&, const RunSpec&),
                           void (*evaluate)(const Settings&, const RunSpec&, Outcome&), Simulate simulate,
                           CheckTire check_tire) {
  const auto read = [](const RunSpec& spec) {
    Settings settings = read_settings<Settings>(spec);
    settings.conditions.complete(spec);
    return settings;
  };
  Scenario scenario;
  scenario.text = std::move(text);
  scenario.settings = list_settings<Settings>();
  scenario.check = [read, plan, check_tire](const RunSpec& spec) {
    const Settings settings = read(spec);
    plan(settings, spec);
    check_tire(spec);
  };
  scenario.run = [read, plan, evaluate, simulate](const RunSpec& spec, const sim::Progress& progress) {
    const Settings settings = read(spec);
    Outcome outcome;
    outcome.settings = settings_to_json(settings);
    const Program program = plan(settings, spec);
    with_effects_named(spec, [&] {
      simulate(spec, settings.conditions, program, progress, outcome);
      evaluate(settings, spec, outcome);
    });
    return outcome;
  };
  return scenario;
}

}  // namespace rollrig::scenarios
