#include "estimation/road_load/coastdown_recording.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <utility>

#include "estimation/run_checks/checked_rows.h"
#include "sim/core/parse_json.h"

namespace fs = std::filesystem;

namespace rollrig::estimation {
namespace {

constexpr const char* kCoastdownPhase = "coastdown ";

/// Weather and road of a simulated test.
struct RecordedConditions {
  std::optional<double> ambient_pressure_Pa;
  double wind_m_s = 0.0;
  double slope = 0.0;
};

fs::path find_recording(const std::string& path) {
  const fs::path given(path);
  if (!fs::is_directory(given)) return given;
  if (fs::exists(given / "recording.csv")) return given / "recording.csv";
  throw InputError(
      {"the folder has no recording", path, 0, "", "", "a folder that 'rollrig run --out' wrote, or a CSV", ""});
}

Json read_manifest(const fs::path& file) {
  const Json manifest = read_json(file.string());
  if (manifest.is_object()) return manifest;
  throw InputError({"the manifest beside the recording is not JSON", file.string(), 0, "", "",
                    "the file as 'rollrig run' wrote it", ""});
}

/// A number of the manifest, if it has it.
std::optional<double> find_number(const Json& manifest, const char* place) {
  const Json::json_pointer at(place);
  if (!manifest.contains(at) || !manifest.at(at).is_number()) return std::nullopt;
  return manifest.at(at).get<double>();
}

/// The vehicle, where the whole of it was simulated.
std::optional<RecordedVehicle> find_vehicle(const Json& manifest) {
  const auto mass_kg = find_number(manifest, "/vehicle/body/mass_kg");
  const auto rotating_kg = find_number(manifest, "/vehicle/body/rotating_mass_kg");
  const auto drag_m2 = find_number(manifest, "/vehicle/body/drag_area_m2");
  const bool one_wheel = find_number(manifest, "/settings/wheels").value_or(4.0) < 2.0;
  if (!mass_kg.has_value() || !rotating_kg.has_value() || !drag_m2.has_value() || one_wheel) return std::nullopt;
  return RecordedVehicle{*mass_kg, *rotating_kg, *drag_m2};
}

RecordedConditions find_conditions(const Json& manifest) {
  RecordedConditions conditions;
  if (const auto kPa = find_number(manifest, "/rig/environment/ambient_pressure_kPa")) {
    conditions.ambient_pressure_Pa = 1e3 * *kPa;
  }
  conditions.wind_m_s = find_number(manifest, "/settings/wind_m_s").value_or(0.0);
  conditions.slope = 0.01 * find_number(manifest, "/settings/slope_percent").value_or(0.0);
  return conditions;
}

CoastdownRun begin_recorded_run(const std::string& phase, double time_s) {
  CoastdownRun run;
  run.id = phase.substr(std::string(kCoastdownPhase).size());
  run.session = "session";
  if (!run.id.empty()) run.heading = run.id.back() == '+' ? 1 : run.id.back() == '-' ? -1 : 0;
  run.start_s = time_s;
  return run;
}

void add_recorded_conditions(const RecordedConditions& conditions, const std::vector<double>& ambient_K,
                             std::size_t row, CoastdownRun& run) {
  if (!ambient_K.empty()) run.conditions.ambient_K.push_back(ambient_K[row]);
  if (conditions.ambient_pressure_Pa.has_value()) {
    run.conditions.ambient_pressure_Pa.push_back(*conditions.ambient_pressure_Pa);
  }
  if (conditions.wind_m_s != 0.0) run.conditions.wind_m_s.push_back(conditions.wind_m_s);
  if (conditions.slope != 0.0) run.conditions.slope.push_back(conditions.slope);
}

}  // namespace

CoastdownFile read_coastdown_recording(const std::string& path, BadRows bad_rows) {
  const fs::path recording = find_recording(path);
  const fs::path manifest_file = recording.parent_path() / "manifest.json";
  CoastdownFile file;
  file.path = recording.string();
  file.is_trace = true;
  RecordedConditions conditions;
  if (fs::exists(manifest_file)) {
    const Json manifest = read_manifest(manifest_file);
    file.is_simulated = true;
    file.vehicle = find_vehicle(manifest);
    conditions = find_conditions(manifest);
  }
  CheckedRows rows(recording.string());
  const CsvTable& table = rows.table();
  const std::vector<double> times = rows.numbers({"time_s", any_number(), ""});
  const std::vector<double> speeds = rows.numbers({"speed_km_h", between(-500.0, 500.0), ""});
  const std::vector<std::string> phases = table.text("phase");
  const std::vector<double> ambient_K =
      table.has("ambient_degC") ? rows.numbers({"ambient_degC", between(-60.0, 80.0), ""}) : std::vector<double>();
  std::vector<std::size_t> all(rows.row_count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  rows.check_times("time_s", all, times, "");
  file.left_out = rows.settle(bad_rows);
  std::string phase;  // of the row before
  for (const std::size_t row : all) {
    if (rows.is_out(row)) continue;
    const bool begins = phases[row] != std::exchange(phase, phases[row]);
    if (phase.rfind(kCoastdownPhase, 0) != 0) continue;
    if (begins) file.data.runs.push_back(begin_recorded_run(phase, times[row]));
    CoastdownRun& run = file.data.runs.back();
    run.time_s.push_back(times[row]);
    run.speed_m_s.push_back(std::max(0.0, speeds[row]));
    add_recorded_conditions(conditions, ambient_K, row, run);
  }
  if (file.data.runs.empty()) {
    throw InputError({"the recording has no coastdown", recording.string(), 0, "phase", "",
                      "phases 'coastdown 1 +', 'coastdown 1 -' and so on, as of 'rollrig run coastdown'", ""});
  }
  return file;
}

}  // namespace rollrig::estimation
