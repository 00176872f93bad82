#include "scenarios/common/follow_bench.h"

#include <algorithm>

#include "measurements/read_force.h"
#include "measurements/resimulation.h"
#include "models/tire_reference.h"
#include "scenarios/run/fidelity.h"

namespace rollrig::scenarios {
namespace {

/// The measurement set that the run would be of.
measurements::MeasurementSet make_set(const RunSpec& spec, const measurements::MeasuredRun& rows) {
  measurements::MeasurementSet set;
  set.kind = spec.rig.kind;
  set.baseline = spec.baseline;
  set.tire = spec.tire;
  if (!set.kind->names_rig()) {
    set.vehicle = spec.vehicle;
    rigs::share_tire(set.tire, *set.vehicle);
  } else {
    set.rig = spec.rig;
  }
  set.runs = {rows};
  return set;
}

/// Puts given columns before what was simulated, of which each channel stays once.
void put_given_first(const measurements::MeasuredRun& rows, const rigs::MachineKind& kind,
                     sim::Recording<double>& recording) {
  std::vector<sim::Channel> channels;
  std::vector<std::vector<double>> values;
  const auto add = [&](const Quantity& quantity, const std::vector<double>& column) {
    const auto is_same = [&](const sim::Channel& channel) { return channel.quantity == quantity; };
    if (std::any_of(channels.begin(), channels.end(), is_same)) return;
    channels.push_back({quantity});
    values.push_back(column);
  };
  for (const rigs::Column& column : kind.columns.all_given()) {
    if (rows.has(column.quantity)) add(column.quantity, rows.column(column.quantity));
  }
  for (std::size_t i = 0; i < recording.channels.size(); ++i) add(recording.channels[i].quantity, recording.values[i]);
  recording.channels = std::move(channels);
  recording.values = std::move(values);
}

/// Weights on the sensor of the force show in it.
void read_hung_force(const rigs::MachineKind& kind, const measurements::MeasuredRun& rows,
                     const models::Corner<double>& corner, sim::Recording<double>& recording) {
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const Quantity& channel = recording.channels[i].quantity;
    if (channel != kind.traits.force) continue;
    recording.values[i] = measurements::read_force(rows, corner, recording.values[i], channel);
  }
}

/// Phases are the run-up, where there is one, and the file.
void name_phases(sim::Recording<double>& recording) {
  const std::vector<double>& time_s = recording.time_s;
  recording.phases.clear();
  recording.phase_integrals.clear();
  if (time_s.front() < 0.0) recording.phases.push_back({"run-up", time_s.front(), 0.0});
  recording.phases.push_back({"program", 0.0, time_s.back()});
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    recording.phase[i] = time_s[i] < 0.0 ? 0 : recording.phases.size() - 1;
  }
}

}  // namespace

models::Context<double> make_follow_context(const RunSpec& spec, const measurements::MeasuredRun& rows) {
  const models::Context<double> context = measurements::make_context(make_set(spec, rows));
  models::require_tire_reference(context, spec.effects, spec.tire.path);
  return context;
}

void simulate_rows(const RunSpec& spec, const RecordedInputs&, const measurements::MeasuredRun& rows,
                   const sim::Progress& progress, Outcome& outcome) {
  const measurements::MeasurementSet set = make_set(spec, rows);
  models::Corner<double> corner(measurements::make_context(set), spec.effects);
  outcome.recording = measurements::Resimulation(rows, *set.kind).simulate(set, rows, corner, rigs::Detail::kFull);
  outcome.recording.audit.require_closed(sim::kAuditLimit);
  put_given_first(rows, *set.kind, outcome.recording);
  read_hung_force(*set.kind, rows, corner, outcome.recording);
  name_phases(outcome.recording);
  outcome.set_runs = {SetRun{rows, rows.time_s.front(), rows.time_s.back()}};
  apply_sensors(spec, outcome.recording);
  if (progress) progress(1.0);
}

}  // namespace rollrig::scenarios
