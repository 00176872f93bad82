#pragma once
/// Runs a drum program in the fidelity asked for, with effects, audits and sensors.

#include "scenarios/drum_program.h"
#include "scenarios/scenario.h"

namespace rollrig::scenarios {

/// Channels that a drum rig measures (formats.md), and the gas temperature, which some sensors have (3.16).
const std::vector<std::string>& measured_drum_channels();

/// Simulates `program` from a soaked tire, checks both audits, applies trace effects and sensors to the
/// measured channels, and puts recording, set runs and statistics into `outcome`.
void simulate_on_drum(const RunSpec& spec, const DrumConditions& conditions, const DrumProgram& program,
                      const sim::Progress& progress, Outcome& outcome);

/// A scenario on the drum: settings (with a member `conditions`) are read and completed, `plan` makes the
/// program, it is simulated, `evaluate` fills result, lines and tables.
template <class Settings>
Scenario make_drum_scenario(ScenarioText text, DrumProgram (*plan)(const Settings&, const RunSpec&),
                            void (*evaluate)(const Settings&, const RunSpec&, Outcome&)) {
  const auto read = [](const RunSpec& spec) {
    Settings settings = read_settings<Settings>(spec);
    settings.conditions.complete(spec);
    return settings;
  };
  Scenario scenario;
  scenario.text = std::move(text);
  scenario.settings = list_settings<Settings>();
  scenario.check = [read, plan](const RunSpec& spec) {
    const Settings settings = read(spec);
    plan(settings, spec);
    rigs::make_context(spec.tire, spec.rig, spec.baseline);
  };
  scenario.run = [read, plan, evaluate](const RunSpec& spec, const sim::Progress& progress) {
    const Settings settings = read(spec);
    Outcome outcome;
    outcome.settings = settings_to_json(settings);
    simulate_on_drum(spec, settings.conditions, plan(settings, spec), progress, outcome);
    evaluate(settings, spec, outcome);
    return outcome;
  };
  return scenario;
}

}  // namespace rollrig::scenarios
