#pragma once
/// Measurement sets of formats.md: a folder with set.toml and one CSV a run.

#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/bad_rows.h"
#include "measurements/left_out_rows.h"
#include "models/quantities.h"
#include "models/sensor.h"
#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"

namespace rollrig::measurements {

using rigs::MachineKind;
using rigs::measured_channels;

/// What [[run]] says of a run in sets and mappings alike.
struct RunTable {
  std::string id;
  std::string session = "session";
  double initial_tire_temperature_K = 0.0;
  double cold_pressure_Pa = 0.0;  // gauge, at that temperature
  std::optional<double> rest_before_s;
  bool started_warm = false;
  // The force read while the surface stands, nothing holding it, is the sensor's zero.
  bool force_at_standstill = false;
};

struct MeasuredRun : RunTable {
  std::string file;       // path
  bool reversed = false;  // a drum or a roller, turned the other way round
  std::vector<double> time_s;
  // Where the mean that a row holds begins, and that of the last row ends; empty: half-way between rows.
  std::vector<double> mean_bounds_s;
  QuantityMap<std::vector<double>> columns;  // SI; NaN where there is no sample
  LeftOutRows left_out;

  bool has(const Quantity& quantity) const { return columns.count(quantity) > 0; }
  /// Throws std::out_of_range for a column that the run does not have.
  const std::vector<double>& column(const Quantity& quantity) const { return columns.at(quantity); }
  std::vector<double>& column(const Quantity& quantity) { return columns.at(quantity); }
  /// Whether a column holds anything but empty fields.
  bool has_samples(const Quantity& quantity) const;
};

struct MeasurementSet {
  std::string path;  // of set.toml
  std::string name;
  const MachineKind* kind = nullptr;
  models::Baseline baseline = models::Baseline::kCombined;
  models::TireFile tire;
  std::optional<rigs::RigFile> rig;          // of a kind that names a rig
  std::optional<rigs::VehicleFile> vehicle;  // of the other kinds
  models::SensorSet sensors;
  std::vector<Quantity> assumed_sensors;  // channels of which the set says nothing: those of its kind
  std::vector<MeasuredRun> runs;
};

/// The first line of set.toml: form /2 of a kind that /1 does not have.
std::string write_set_format(const MachineKind& kind);

/// Reads the set in `folder` (or the path of its set.toml) with everything that it names. Throws InputError; bad rows
/// of all files are in one error (run_rows.h), or left out.
MeasurementSet read_measurement_set(const std::string& folder, BadRows bad_rows = BadRows::kRefuse);

/// The inputs of a run from a run file of a set, or from one with the given columns alone; measured columns are not
/// kept. Throws InputError.
MeasuredRun read_run_inputs(const std::string& file, const MachineKind& kind);

/// The machine that a set or a mapping names: a rig, or a vehicle on the road. Decides the kind of `set`, whose
/// tire has been read; returns the machine's file as it is. Throws InputError.
std::string read_machine(TableReader& reader, const std::string& folder, MeasurementSet& set);

/// The keys of a [[run]] that RunTable holds, but for its id. Throws InputError.
void read_run_table(TableReader& reader, RunTable& run);
/// A [[run]] of set.toml; its samples are in <id>.csv.
std::string write_run_table(const RunTable& run);

/// A text as TOML has it.
std::string quote(const std::string& text);

/// Tables [sensors.<channel>] of sets and run files.
std::string write_sensors(const models::SensorSet& sensors);

}  // namespace rollrig::measurements
