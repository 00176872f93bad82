#include "scenarios/common/wheel_bench.h"

#include "scenarios/common/virtual_sensors.h"

namespace rollrig::scenarios {
namespace {

/// The measurement set that the run would be of.
measurements::MeasurementSet make_set(const RunSpec& spec, const measurements::MeasuredRun& rows) {
  measurements::MeasurementSet set;
  set.kind = *spec.scenario->set_kind;
  set.baseline = spec.baseline;
  set.tire = spec.tire;
  if (set.kind == measurements::SetKind::kRoad) {
    set.vehicle = spec.vehicle;
  } else {
    set.rig = spec.rig;
  }
  set.runs = {rows};
  return set;
}

models::Context<double> make_context(const measurements::MeasurementSet& set) {
  return set.kind == measurements::SetKind::kRoad ? measurements::make_road_context(set)
                                                  : rigs::make_context(set.tire, *set.rig, set.baseline);
}

/// Adds a recording's channels to those of another with the same rows; what is there already stays.
void add_channels(sim::Recording<double> from, sim::Recording<double>& recording) {
  for (std::size_t i = 0; i < from.channels.size(); ++i) {
    const auto is_same = [&](const sim::Channel& channel) { return channel.name == from.channels[i].name; };
    if (std::any_of(recording.channels.begin(), recording.channels.end(), is_same)) continue;
    recording.channels.push_back(from.channels[i]);
    recording.values.push_back(std::move(from.values[i]));
  }
}

/// Rows with their given columns; phases are the run-up, where there is one, and the file.
sim::Recording<double> begin_recording(const measurements::MeasuredRun& rows, measurements::SetKind kind) {
  sim::Recording<double> recording;
  recording.time_s = rows.time_s;
  if (rows.time_s.front() < 0.0) recording.phases.push_back({"run-up", rows.time_s.front(), 0.0});
  recording.phases.push_back({"program", 0.0, rows.time_s.back()});
  for (const double time_s : rows.time_s) recording.phase.push_back(time_s < 0.0 ? 0 : recording.phases.size() - 1);
  const measurements::SetColumns& columns = measurements::columns_of(kind);
  for (const auto* fields : {&columns.given, &columns.optional_given}) {
    for (const Field& field : *fields) {
      if (!rows.has(field.key)) continue;
      recording.channels.push_back({field.key});
      recording.values.push_back(rows.columns.at(field.key));
    }
  }
  return recording;
}

}  // namespace

models::Context<double> make_wheel_context(const RunSpec& spec, const measurements::MeasuredRun& rows) {
  return make_context(make_set(spec, rows));
}

void simulate_rows(const RunSpec& spec, const RecordedInputs&, const measurements::MeasuredRun& rows,
                   const sim::Progress& progress, Outcome& outcome) {
  const measurements::MeasurementSet set = make_set(spec, rows);
  models::Corner<double> corner(make_context(set), spec.effects);
  const std::vector<measurements::WheelInterval> intervals = measurements::make_wheel_intervals(rows);
  const bool is_road = set.kind == measurements::SetKind::kRoad;
  const auto ledger = is_road ? measurements::make_road_ledger(rows, corner, set.vehicle->tires)
                              : measurements::make_dyno_ledger(rows, corner);
  const auto replay = is_road ? measurements::replay_road_run<double> : measurements::replay_dyno_run<double>;
  outcome.recording = begin_recording(rows, set.kind);
  add_channels(replay(set, rows, intervals, corner, ledger.get()), outcome.recording);
  add_channels(ledger->take_means(), outcome.recording);
  outcome.recording.audit = ledger->make_audit();
  outcome.recording.audit.require_closed(sim::kAuditLimit);
  SetRun run;
  run.id = rows.id;
  run.start_s = rows.time_s.front();
  run.end_s = rows.time_s.back();
  run.initial_tire_temperature_K = rows.initial_tire_temperature_K;
  run.cold_pressure_Pa = rows.cold_pressure_Pa;
  run.rest_before_s = rows.rest_before_s;
  run.started_warm = rows.started_warm;
  outcome.set_runs = {run};
  apply_sensors(spec, outcome.recording);
  if (progress) progress(1.0);
}

}  // namespace rollrig::scenarios
