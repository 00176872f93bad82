#pragma once
/// Simulates the rows of a file as a run of a measurement set is simulated again: one wheel on its roller, or a vehicle
/// on the road.

#include "scenarios/common/recorded_inputs.h"
#include "scenarios/run/rig_scenario.h"

namespace rollrig::scenarios {

/// What the equations take of the spec's tire on its roller or on the road. Throws InputError.
models::Context<double> make_follow_context(const RunSpec& spec, const measurements::MeasuredRun& rows);

/// Simulates `rows`, checks both audits, applies sensors, and puts recording and set run into `outcome`: given columns,
/// measured ones, then what only a simulation knows. A set written of it is resimulated to the same values.
void simulate_rows(const RunSpec& spec, const RecordedInputs& given, const measurements::MeasuredRun& rows,
                   const sim::Progress& progress, Outcome& outcome);

/// A scenario whose settings have a RecordedInputs as `conditions`, on a rig or, without one, on the road; see
/// rig_scenario.h. Quasi-static alone: the rows say what moves, so that there are no mechanics to simulate.
template <class Settings, class Results>
Scenario make_follow_scenario(ScenarioText text, std::string default_rig,
                              Results (*evaluate)(const Settings&, const RunSpec&, Outcome&)) {
  const auto plan = +[](const Settings& settings, const RunSpec& spec) { return settings.conditions.make_rows(spec); };
  Scenario scenario = make_rig_scenario(std::move(text), plan, evaluate, &simulate_rows,
                                        [](const RunSpec& spec) { make_follow_context(spec, {}); });
  scenario.default_rig = std::move(default_rig);
  scenario.has_vehicle = !scenario.has_rig();
  scenario.runs_on = scenario.has_vehicle ? &models::is_on_road : &models::is_tied_down;
  scenario.fidelities = {Fidelity::kQuasiStatic};
  scenario.writes_sets = true;
  return scenario;
}

}  // namespace rollrig::scenarios
