#pragma once
/// A scenario that is one program on one rig, whichever the rig.

#include "scenarios/run/settings.h"

namespace rollrig::scenarios {

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
    simulate(spec, settings.conditions, plan(settings, spec), progress, outcome);
    evaluate(settings, spec, outcome);
    return outcome;
  };
  return scenario;
}

}  // namespace rollrig::scenarios
