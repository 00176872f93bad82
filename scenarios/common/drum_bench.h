#pragma once
/// Runs a drum program in the fidelity asked for, with effects, audits and sensors.

#include "scenarios/common/drum_program.h"
#include "scenarios/run/rig_scenario.h"

namespace rollrig::scenarios {

/// Simulates `program` from a soaked tire, checks both audits, applies trace effects and sensors to the
/// measured channels, and puts recording, set runs and statistics into `outcome`.
void simulate_on_drum(const RunSpec& spec, const DrumConditions& conditions, const DrumProgram& program,
                      const sim::Progress& progress, Outcome& outcome);

/// Throws InputError where tire and rig do not give the equations what they need, or the carriage would bounce on the
/// tire through the whole test.
void check_drum(const RunSpec& spec);

/// A scenario on the drum; see rig_scenario.h.
template <class Settings, class Results>
Scenario make_drum_scenario(ScenarioText text, DrumProgram (*plan)(const Settings&, const RunSpec&),
                            Results (*evaluate)(const Settings&, const RunSpec&, Outcome&)) {
  Scenario scenario = make_rig_scenario(std::move(text), plan, evaluate, &simulate_on_drum, &check_drum);
  scenario.writes_sets = true;
  return scenario;
}

}  // namespace rollrig::scenarios
