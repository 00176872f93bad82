// What can be exported, read from where rollrig wrote it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "exports/tree.h"
#include "measurements/run_rows.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parse_json.h"

namespace fs = std::filesystem;

namespace rollrig::exports {
namespace {

constexpr const char* kFormat = "rollrig-export/1";
constexpr const char* kExportable =
    "a folder with result.json, recording.csv and manifest.json (rollrig run --out), a measurement set (a folder with "
    "set.toml), or a recording.csv";

Group start_tree(const char* source) {
  Group tree;
  tree.add("format", {std::string(kFormat)});
  tree.add("source", {std::string(source)});
  return tree;
}

/// The columns of a CSV file as they stand: `phase` is text, all others are numbers, in the unit of their name.
Group read_recording(const std::string& path) {
  const CsvTable csv = CsvTable::read(path);
  Group recording;
  recording.is_table = true;
  csv.increasing_times("time_s");
  for (const std::string& column : csv.columns()) {
    recording.add(column, column == "phase" ? Node{csv.text(column)} : Node{csv.plain_numbers(column, {})});
  }
  return recording;
}

Json read_result(const std::string& path) {
  Json json = read_json(path);
  const Json format = json.is_object() ? json.value("format", Json()) : Json();
  if (format == "rollrig-result/1") return json;
  throw InputError({"not a result of a run", path, 0, "format", format.is_string() ? format.get<std::string>() : "",
                    "\"rollrig-result/1\"", ""});
}

Group read_result_folder(const fs::path& folder) {
  Group tree = start_tree("result");
  const Json result = read_result((folder / "result.json").string());
  tree.add("recording", {read_recording((folder / "recording.csv").string())});
  tree.add("result", make_node(result));
  tree.add("manifest", {read_text_file((folder / "manifest.json").string())});
  return tree;
}

/// The columns of a run whose file has rows that were left out, in the order of the file.
Group make_recording(const measurements::MeasuredRun& run) {
  RowProblems left_out;
  const CsvTable csv = CsvTable::read(run.file, {}, &left_out);
  Group recording;
  recording.is_table = true;
  for (const std::string& column : csv.columns()) {
    if (column == "time_s") {
      recording.add(column, {run.time_s});
      continue;
    }
    const Quantity quantity = intern_quantity(column);
    std::vector<double> values = run.column(quantity);
    for (double& value : values) value = quantity.file_unit().from_si(value);
    recording.add(column, {values});
  }
  return recording;
}

Group make_run(const ConfigTable& table, const measurements::MeasuredRun& measured) {
  Group run = std::get<Group>(make_node(table).value);
  const bool is_whole = measured.left_out.problems.empty();
  run.add("recording", {is_whole ? read_recording(measured.file) : make_recording(measured)});
  return run;
}

Group read_set(const std::string& path, BadRows bad_rows, std::vector<std::string>* warnings) {
  const measurements::MeasurementSet set = measurements::read_measurement_set(path, bad_rows);  // checks all of it
  ConfigTable config = read_config(set.path);
  const ConfigArray tables = *config.find("run")->as_array();
  config.entries.erase("run");
  Group tree = start_tree("measurements");
  tree.add("set", make_node(config));
  tree.add("tire", make_node(parse_config(set.tire.content, set.tire.path)));
  if (set.rig.has_value()) tree.add("rig", make_node(parse_config(set.rig->content, set.rig->path)));
  if (set.vehicle.has_value()) tree.add("vehicle", make_node(parse_config(set.vehicle->content, set.vehicle->path)));
  Group runs;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    throw_if_interrupted();
    runs.add(set.runs[i].id, {make_run(*tables[i].as_table(), set.runs[i])});
  }
  tree.add("runs", {std::move(runs)});
  const Json left_out = measurements::make_bad_rows_json(set);
  if (!left_out.empty()) tree.add("bad_rows", make_node(left_out));
  if (warnings != nullptr) *warnings = measurements::describe_bad_rows(set);
  return tree;
}

Group read_folder(const fs::path& folder, BadRows bad_rows, std::vector<std::string>* warnings) {
  if (fs::exists(folder / "result.json")) return read_result_folder(folder);
  if (fs::exists(folder / "set.toml")) return read_set(folder.string(), bad_rows, warnings);
  throw InputError({fmt::format("'{}' holds neither a result nor a measurement set", folder.string()), folder.string(),
                    0, "", "", kExportable, ""});
}

/// What stands beside a path that is not there.
std::vector<std::string> list_neighbors(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(fs::absolute(path).parent_path(), code)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Group read_source(const std::string& path, BadRows bad_rows, std::vector<std::string>* warnings) {
  if (fs::is_directory(path)) return read_folder(path, bad_rows, warnings);
  const fs::path file(path);
  if (!fs::exists(file)) {
    throw InputError({fmt::format("no such file or folder '{}'", path), path, 0, "", "", kExportable,
                      nearest_name(file.filename().string(), list_neighbors(file))});
  }
  if (file.filename() == "set.toml") return read_set(path, bad_rows, warnings);
  if (file.extension() != ".csv") {
    throw InputError({fmt::format("'{}' is not what can be exported", path), path, 0, "", "", kExportable,
                      nearest_name(file.filename().string(), {"recording.csv", "set.toml"})});
  }
  Group tree = start_tree("recording");
  tree.add("recording", {read_recording(path)});
  return tree;
}

}  // namespace rollrig::exports
