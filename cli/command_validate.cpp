#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/print.h"
#include "diagnosis/checks/set_checks.h"
#include "diagnosis/output/fleet.h"
#include "estimation/drum_deceleration/coast_set.h"
#include "measurements/measurement_set.h"
#include "measurements/sensor_file.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/csv.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

struct Finding {
  std::string what;
  std::vector<std::string> warnings = {};
  bool is_good = true;
};

bool has_measured(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run) {
  const std::vector<std::string> channels = measurements::measured_channels(*set.kind);
  return std::any_of(channels.begin(), channels.end(),
                     [&run](const std::string& channel) { return run.has_samples(channel); });
}

/// A set is held against the simulation as well: exchanged columns and wrong units are in no single number.
Finding validate_set(const std::string& path) {
  const measurements::MeasurementSet set = measurements::read_measurement_set(path);
  std::size_t rows = 0;
  std::size_t without = 0;
  for (const measurements::MeasuredRun& run : set.runs) {
    rows += run.time_s.size();
    if (!has_measured(set, run)) without += run.time_s.size();
  }
  const diagnosis::SetChecks checks = diagnosis::check_set(set);
  const std::string empty = without == 0 ? "" : fmt::format(", {} of them in runs that measured nothing", without);
  return {fmt::format("measurement set '{}': {}, {}{}", set.name, format_count(set.runs.size(), "run"),
                      format_count(rows, "row"), empty),
          checks.warnings, !checks.is_implausible()};
}

Finding validate_cycle(const std::string& path) {
  const CsvTable csv = CsvTable::read(path);
  try {
    csv.require_known({"time_s", "speed_km_h"});
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    problem.what += ": a CSV by itself is read as a drive cycle";
    problem.allowed += "; or in its place the folder of the measurement set to which it belongs";
    throw InputError(problem);
  }
  csv.increasing_times("time_s");
  csv.numbers({"speed_km_h", between(0.0, 400.0), "speed"});
  return {"cycle: " + format_count(csv.row_count(), "row")};
}

Finding validate_toml(const std::string& path) {
  const ConfigTable config = read_config(path);
  TableReader reader(config, "");
  const std::string format = reader.text("format");
  const std::string kind = format.substr(0, format.find('/'));
  if (kind == "rollrig-tire") return {fmt::format("tire '{}'", models::read_tire(config).name)};
  if (kind == "rollrig-rig") return {fmt::format("rig '{}'", rigs::read_rig(config).name)};
  if (kind == "rollrig-sensors")
    return {"sensors: " + format_count(measurements::read_sensor_file(config).size(), "channel")};
  if (kind == "rollrig-measurements") return validate_set(path);
  if (kind == "rollrig-vehicle") return {fmt::format("vehicle '{}'", rigs::read_vehicle(config).name)};
  if (kind == "rollrig-drum-coastdown") {
    const estimation::CoastSet set = estimation::read_coast_set(path);
    return {fmt::format("set of drum coast-downs '{}': {}", set.name, format_count(set.runs.size(), "run"))};
  }
  if (kind == "rollrig-run") {
    const scenarios::RunSpec spec = scenarios::read_run_spec(config, fs::path(path).parent_path().string());
    scenarios::prepare_run(spec);
    return {fmt::format("run of scenario '{}'", spec.scenario->text.name)};
  }
  InputProblem problem = unknown_name("format", kind,
                                      {"rollrig-tire", "rollrig-rig", "rollrig-run", "rollrig-sensors",
                                       "rollrig-measurements", "rollrig-vehicle", "rollrig-drum-coastdown"});
  problem.file = path;
  problem.key = "format";
  throw InputError(problem);
}

Finding validate(const std::string& path) {
  if (fs::is_directory(path)) return validate_set(path);
  return fs::path(path).extension() == ".csv" ? validate_cycle(path) : validate_toml(path);
}

/// A folder of sets stands for these.
std::vector<std::string> list_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    const std::vector<std::string> sets = diagnosis::find_sets(path);
    if (!sets.empty()) warn_of_undescribed(path);
    files.insert(files.end(), sets.begin(), sets.end());
    if (sets.empty()) files.push_back(path);
  }
  return files;
}

/// What a CI job asks: 2 where a file is wrong, 1 where a set cannot be what it is said to be, as of a regression that
/// differs. A set that is merely warned of is good.
int validate_command(const std::vector<std::string>& paths) {
  int status = kDone;
  for (const std::string& path : list_files(paths)) {
    try {
      const Finding found = validate(path);
      std::cout << wrap(fmt::format("{}: {} {}", path, found.is_good ? "good" : "doubtful", found.what), 2).substr(2);
      for (const std::string& warning : found.warnings) std::cout << wrap(warning, 2);
      if (!found.is_good) status = std::max<int>(status, kDiffers);
    } catch (const InputError& error) {  // of one file: the others are checked as well
      std::cout << std::flush;
      std::cerr << format_error("error: ", error.problem());
      status = kInputError;
    }
  }
  return status;
}

}  // namespace

void add_validate_command(CLI::App& app, Action& action) {
  const auto [command, paths] = add_command<std::vector<std::string>>(
      app, action, "validate",
      "Check files; of a measurement set also whether columns and units can be right: exit status 1 where they cannot",
      &validate_command);
  command
      ->add_option("file", *paths,
                   "Tire, rig, run, sensors, vehicle or set.toml, a set's folder or one with such folders, or a "
                   "cycle's CSV")
      ->required();
}

}  // namespace rollrig::cli
