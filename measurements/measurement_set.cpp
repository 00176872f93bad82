#include "measurements/measurement_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "measurements/run_rows.h"
#include "sim/core/assets.h"
#include "sim/core/data_file.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig::measurements {
namespace {

std::string set_file_of(const std::string& folder) {
  std::error_code none;  // a name that is too long, say, is none of a folder
  if (fs::is_directory(folder, none)) return (fs::path(folder) / "set.toml").string();
  return folder;
}

std::string folder_of(const std::string& file) { return fs::path(file).parent_path().string(); }

MeasuredRun read_run(const ConfigTable& table, const std::string& folder, const MachineKind& kind) {
  TableReader reader(table, "[[run]]");
  MeasuredRun run;
  run.id = reader.text("id");
  if (run.id.empty()) throw reader.problem("id", "a run needs a name", "a text that is not empty");
  const std::string file = reader.text("file");
  if (file.empty()) throw reader.problem("file", "a run needs a file", "a path relative to this file");
  run.file = place_data_file(reader, "file", folder, file);
  std::error_code none;
  if (!fs::exists(run.file, none)) {
    InputProblem missing =
        reader.problem("file", fmt::format("no such file '{}'", run.file), "a path relative to this file").problem();
    missing.nearest = nearest_file(run.file);
    throw InputError(missing);
  }
  read_run_table(reader, run);
  if (reader.flag_or("reversed", false)) {
    if (!is_indoors(kind.traits))
      throw reader.problem("reversed", "only a drum or a roller is turned the other way round", "false");
    run.reversed = true;
  }
  reader.finish();
  return run;
}

void check_runs(const MeasurementSet& set) {
  std::set<std::string> ids;
  for (const MeasuredRun& run : set.runs) {
    if (!ids.insert(run.id).second) {
      throw InputError({fmt::format("two runs have the id '{}'", run.id), set.path, 0, "[[run]] id", run.id,
                        "a different id for every run", ""});
    }
    for (const Quantity& channel : measured_channels(*set.kind)) {
      if (!run.has(channel) || set.sensors.count(channel) > 0) continue;
      const std::string heading = channel.header();
      const std::string table = fmt::format("[sensors.{}]", heading);
      throw InputError(
          {fmt::format("run '{}' measures '{}', and no sensor is given for it", run.id, heading), set.path, 0, table,
           "", fmt::format("a table {} with offset_sd, drift_sd, drift_time_s, noise_sd, resolution", table), ""});
    }
  }
}

}  // namespace

bool MeasuredRun::has_samples(const Quantity& quantity) const {
  const auto at = columns.find(quantity);
  return at != columns.end() &&
         std::any_of(at->second.begin(), at->second.end(), [](double value) { return !std::isnan(value); });
}

void read_run_table(TableReader& reader, RunTable& run) {
  run.session = reader.text("session");
  run.initial_tire_temperature_K = reader.number({"initial_tire_temperature_degC", models::kTemperatureRange, ""});
  run.cold_pressure_Pa = reader.number({"cold_pressure_kPa", between(20.0, 2000.0), ""});
  constexpr double kLongestRest_min = 1e7;  // Assumed: 19 years
  run.rest_before_s = reader.number_or_none({"rest_before_min", between(0.0, kLongestRest_min), ""});
  run.started_warm = reader.text_or("tire_state", "soaked", {"soaked", "warm"}) == "warm";
  run.force_at_standstill = reader.flag_or("force_at_standstill", false);
}

std::string quote(const std::string& text) { return Json(text).dump(); }  // its escapes are among those of TOML

std::string write_run_table(const RunTable& run) {
  std::string text = fmt::format(
      "\n[[run]]\nid = {}\nfile = {}\nsession = {}\ninitial_tire_temperature_degC = {:.10g}\ncold_pressure_kPa = "
      "{:.10g}\n",
      quote(run.id), quote(run.id + ".csv"), quote(run.session), run.initial_tire_temperature_K - kZeroCelsius_K,
      run.cold_pressure_Pa / 1e3);
  if (run.rest_before_s.has_value()) text += fmt::format("rest_before_min = {:.10g}\n", *run.rest_before_s / 60.0);
  if (run.started_warm) text += "tire_state = \"warm\"\n";
  if (run.force_at_standstill) text += "force_at_standstill = true\n";
  return text;
}

MeasuredRun read_run_inputs(const std::string& file, const MachineKind& kind) {
  MeasuredRun run;
  run.id = fs::path(file).stem().string();
  run.file = file;
  const RunFileRows rows = read_run_columns(kind.columns, run);
  if (!rows.problems.empty()) {
    throw make_rows_error(format_count(count_rows(rows.problems), "bad row"), rows.problems, "", "");
  }
  for (const Quantity& channel : measured_channels(kind)) run.columns.erase(channel);
  return run;
}

std::string read_machine(TableReader& reader, const std::string& folder, MeasurementSet& set) {
  const std::string word = reader.text_or("kind", "");
  set.kind = rigs::find_machine_kind_if_any(word);
  if (!word.empty() && set.kind == nullptr) reader.text("kind", rigs::set_words());  // throws
  if (word.empty() && reader.has("vehicle")) set.kind = &rigs::find_kind_without_rig(&models::is_any);
  if (set.kind != nullptr && !set.kind->names_rig()) {
    const std::string path = find_asset_of(reader, "vehicle", folder, "vehicles", reader.text("vehicle"));
    set.vehicle = rigs::read_vehicle(read_config(path));
    set.vehicle->content = read_text_file(path);
    rigs::share_tire(set.tire, *set.vehicle);
    return set.vehicle->content;
  }
  const std::string path = find_asset_of(reader, "rig", folder, "rigs", reader.text("rig"));
  set.rig = rigs::read_rig(read_config(path));
  set.rig->content = read_text_file(path);
  rigs::use_skim_load_of_class(*set.rig, set.tire);
  if (!set.rig->kind->names_rig()) {
    throw reader.problem("rig", fmt::format("rig '{}' is a road, where a set names a vehicle", set.rig->name),
                         "a rig of another kind, or vehicle = ... with kind = \"road\"");
  }
  if (set.kind != nullptr && set.kind != set.rig->kind) {
    throw reader.problem("kind", fmt::format("kind is '{}', but the rig '{}' is of another kind", word, set.rig->name),
                         "the rig's kind");
  }
  set.kind = set.rig->kind;
  return set.rig->content;
}

namespace {

/// Sensors that runs use and the set does not describe.
void assume_sensors(MeasurementSet& set) {
  for (const auto& [channel, sensor] : set.kind->default_sensors) {
    const bool used = std::any_of(set.runs.begin(), set.runs.end(),
                                  [&channel = channel](const MeasuredRun& run) { return run.has(channel); });
    if (!used || set.sensors.count(channel) > 0) continue;
    set.sensors[channel] = sensor;
    set.assumed_sensors.push_back(channel);
  }
}

}  // namespace

std::string write_set_format(const MachineKind& kind) {
  return fmt::format("format = \"rollrig-measurements/{}\"\n", *kind.former_word == '\0' ? 2 : 1);
}

MeasurementSet read_measurement_set(const std::string& folder, BadRows bad_rows) {
  MeasurementSet set;
  set.path = set_file_of(folder);
  if (fs::is_directory(folder) && !fs::exists(set.path)) {
    throw InputError({fmt::format("there is no set.toml in '{}'", folder), folder, 0, "", "",
                      "a folder with set.toml (tire, rig, sensors, a [[run]] for each CSV; docs/formats.md); "
                      "assets/examples/hidden_effect is one to copy, rollrig import makes one from logs; diagnose and "
                      "validate also take a folder of such folders",
                      ""});
  }
  const ConfigTable config = read_config(set.path);
  const std::string base = folder_of(set.path);
  TableReader reader(config, "");
  check_format(reader, "rollrig-measurements", 2);
  set.name = reader.text("name");
  set.baseline = reader.text_or("baseline", "combined", {"combined", "constant_rrc"}) == "combined"
                     ? models::Baseline::kCombined
                     : models::Baseline::kConstantRrc;
  const std::string tire_path = find_asset_of(reader, "tire", base, "tires", reader.text("tire"));
  set.tire = models::read_tire(read_config(tire_path));
  set.tire.content = read_text_file(tire_path);
  read_machine(reader, base, set);
  if (const ConfigTable* sensors = reader.table("sensors")) {
    set.sensors = models::read_sensors(*sensors, measured_channels(*set.kind));
  }
  for (const ConfigTable* run : reader.tables("run")) set.runs.push_back(read_run(*run, base, *set.kind));
  reader.finish();
  if (set.runs.empty()) throw reader.problem("run", "the set has no runs", "one [[run]] table at least");
  std::vector<RunFileRows> rows;
  for (MeasuredRun& run : set.runs) rows.push_back(read_run_columns(set.kind->columns, run));
  settle_bad_rows(set.kind->columns, bad_rows, rows, set.runs);
  assume_sensors(set);
  check_runs(set);
  return set;
}

}  // namespace rollrig::measurements
