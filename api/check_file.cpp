#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "diagnosis/checks/set_checks.h"
#include "estimation/drum_deceleration/coast_set.h"
#include "measurements/sensor_file.h"
#include "rollrig/measurement_set.h"
#include "scenarios/run/run_spec.h"
#include "scenarios/run/tire_validity.h"
#include "scenarios/scaffold/iso_test.h"
#include "sim/core/csv.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

bool has_measured(const measurements::MeasurementSet& set, const measurements::MeasuredRun& run) {
  const std::vector<Quantity> channels = measurements::measured_channels(*set.kind);
  return std::any_of(channels.begin(), channels.end(),
                     [&run](const Quantity& channel) { return run.has_samples(channel); });
}

/// A set is held against the simulation as well: exchanged columns and wrong units are in no single number.
FileCheck validate_set(const std::string& path, BadRows bad_rows, const Progress& progress) {
  constexpr double kRead = 0.5;  // Assumed: share of the time, as measured with a set of 40 runs of 10 h
  const measurements::MeasurementSet set = measurements::read_measurement_set(path, bad_rows);
  std::size_t rows = 0;
  std::size_t without = 0;
  for (const measurements::MeasuredRun& run : set.runs) {
    throw_if_interrupted();
    rows += run.time_s.size();
    if (!has_measured(set, run)) without += run.time_s.size();
  }
  const auto report = [&progress](double share, const std::string& stage) {
    if (progress) progress(kRead + (1.0 - kRead) * share, stage);
  };
  const diagnosis::SetChecks checks = diagnosis::check_set(set, 0, report);
  const std::string empty = without == 0 ? "" : fmt::format(", {} of them in runs that measured nothing", without);
  return {fmt::format("measurement set '{}': {}, {}{}", set.name, format_count(set.runs.size(), "run"),
                      format_count(rows, "row"), empty),
          checks.warnings, !checks.is_implausible()};
}

/// A tire is held against its own RRc as well, as far as its file has what the test needs.
FileCheck validate_tire(const models::TireFile& tire) {
  FileCheck check{fmt::format("tire '{}'", tire.name)};
  check.warnings = scenarios::list_negative_losses(tire);
  check.is_good = check.warnings.empty();
  for (const std::string& doubt : tire.list_class_doubts()) check.warnings.push_back(doubt);
  try {
    if (const auto warning = scenarios::check_iso_rrc(tire)) check.warnings.push_back(*warning);
  } catch (const InputError&) {  // a tire for other tests
  } catch (const RunFailure& failure) {
    check.warnings.push_back(fmt::format("the simulated test of ISO 28580 fails: {}", failure.what()));
  }
  return check;
}

FileCheck validate_cycle(const std::string& path) {
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

FileCheck validate_toml(const std::string& path, BadRows bad_rows, const Progress& progress) {
  const ConfigTable config = read_config(path);
  TableReader reader(config, "");
  const std::string format = reader.text("format");
  const std::string kind = format.substr(0, format.find('/'));
  if (kind == "rollrig-tire") return validate_tire(models::read_tire(config));
  if (kind == "rollrig-rig") return {fmt::format("rig '{}'", rigs::read_rig(config).name)};
  if (kind == "rollrig-sensors")
    return {"sensors: " + format_count(measurements::read_sensor_file(config).size(), "channel")};
  if (kind == "rollrig-measurements") return validate_set(path, bad_rows, progress);
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

}  // namespace

FileCheck check_file(const std::string& path, BadRows bad_rows, const Progress& progress) {
  if (fs::is_directory(path)) return validate_set(path, bad_rows, progress);
  return fs::path(path).extension() == ".csv" ? validate_cycle(path) : validate_toml(path, bad_rows, progress);
}

}  // namespace rollrig
