// Runs of a scenario as the files of a measurement set.
#include "scenarios/run/run_spec.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "measurements/measurement_set.h"
#include "models/quantities.h"
#include "sim/core/csv.h"

namespace rollrig::scenarios {

namespace {

bool holds(const std::vector<rigs::Column>& columns, const Quantity& quantity) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const rigs::Column& column) { return column.quantity == quantity; });
}

/// Whether a set has no sample where the recording has one.
/// Source    formats.md: the loss force is empty below 20 km/h, but for a zero read at standstill, the traction force
///           where friction brakes act
bool is_left_empty(const sim::Recording<double>& recording, const SetRun& run, const Quantity& column,
                   std::size_t row) {
  constexpr double kSlowest_m_s = 20.0 / 3.6;
  if (column == quantities::kLossForce) {
    const double speed_m_s = recording.channel(quantities::kSpeed)[row];
    return speed_m_s < kSlowest_m_s && !(run.force_at_standstill && speed_m_s == 0.0);
  }
  if (column == quantities::kTractionForce) return recording.channel(quantities::kFrictionBrake)[row] > 0.0;
  return false;
}

/// Rows of one run as CSV, times from its start. Where the run is cut out of a longer recording, a mean at
/// its first or last row reaches beyond the cut: that field is left empty.
std::string write_run_csv(const rigs::MachineKind& kind, const sim::Recording<double>& recording, const SetRun& run,
                          const std::vector<Quantity>& columns) {
  CsvWriter csv(list_headers(columns, {"time_s"}));
  constexpr double kSlack_s = 1e-6;
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    const double time_s = recording.time_s[row];
    if (time_s < run.start_s - kSlack_s || time_s > run.end_s + kSlack_s) continue;
    const bool cut_before = std::abs(time_s - run.start_s) <= kSlack_s && row > 0;
    const bool cut_after = std::abs(time_s - run.end_s) <= kSlack_s && row + 1 < recording.row_count();
    csv.add(time_s - run.start_s);
    for (const Quantity& column : columns) {
      const bool beyond = (cut_before || cut_after) && holds(kind.columns.measured, column);
      const bool is_empty = beyond || is_left_empty(recording, run, column, row);
      csv.add(is_empty ? std::nan("") : column.file_unit().from_si(recording.channel(column)[row]));
    }
    csv.end_row();
  }
  return csv.take();
}

/// Given columns that were recorded, and measured ones that have a sensor.
std::vector<Quantity> find_columns(const rigs::MachineKind& kind, const sim::Recording<double>& recording,
                                   const models::SensorSet& sensors) {
  const std::vector<rigs::Column> given = kind.columns.all_given();
  std::vector<Quantity> columns;
  for (const auto& [quantity, integral] : recording.channels) {
    const bool is_read = holds(kind.columns.measured, quantity) && sensors.count(quantity) > 0;
    if (holds(given, quantity) || is_read) columns.push_back(quantity);
  }
  return columns;
}

}  // namespace

std::map<std::string, std::string> write_measurement_set(const RunSpec& spec, const Outcome& outcome,
                                                         const std::string& name) {
  if (!spec.scenario->writes_sets) throw std::invalid_argument("a scenario that writes no set");
  const rigs::MachineKind& kind = *spec.rig.kind;
  const models::SensorSet sensors = spec.sensors.value_or(models::SensorSet{});
  const std::vector<Quantity> columns = find_columns(kind, outcome.recording, sensors);
  const bool names_rig = kind.names_rig();
  std::map<std::string, std::string> files;
  std::string set = fmt::format("{}name = \"{}\"\n{}tire = \"tire.toml\"\n{}\nbaseline = \"{}\"\n",
                                measurements::write_set_format(kind), name,
                                names_rig ? "" : fmt::format("kind = \"{}\"\n", kind.set_word),
                                names_rig ? "rig = \"rig.toml\"" : "vehicle = \"vehicle.toml\"",
                                spec.baseline == models::Baseline::kCombined ? "combined" : "constant_rrc");
  set += measurements::write_sensors(sensors);
  for (const SetRun& run : outcome.set_runs) {
    set += measurements::write_run_table(run);
    files[run.id + ".csv"] = write_run_csv(kind, outcome.recording, run, columns);
  }
  files["set.toml"] = set;
  files["tire.toml"] = models::write_tire(spec.tire);
  files.merge(names_rig ? std::map<std::string, std::string>{{"rig.toml", rigs::write_rig(spec.rig)}}
                        : rigs::write_vehicle_files(*spec.vehicle, ""));
  return files;
}

}  // namespace rollrig::scenarios
