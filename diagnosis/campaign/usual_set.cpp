// Machine, tire and sensors of a campaign.
#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/campaign/campaign.h"
#include "measurements/sensor_file.h"
#include "rigs/vehicle_file.h"
#include "sim/core/assets.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;

/// Throws InputError for a word that is neither a kind nor a rig.
void require_rig(const std::string& word) {
  const std::string ending = ".toml";
  const bool is_path =
      word.find('/') != std::string::npos ||
      (word.size() > ending.size() && word.compare(word.size() - ending.size(), ending.size(), ending) == 0);
  std::vector<std::string> known = list_assets("rigs");
  if (is_path || std::find(known.begin(), known.end(), find_present_name("rigs", word)) != known.end()) return;
  for (const std::string& kind : rigs::machine_words()) {
    if (std::find(known.begin(), known.end(), kind) == known.end()) known.push_back(kind);
  }
  InputProblem problem = unknown_name("machine", word, known);
  problem.file = "command line";
  problem.key = "--rig";
  throw InputError(problem);
}

template <class Read>
auto read_named(const char* folder, const std::string& name, const Read& read) {
  const std::string path = find_asset(folder, name);
  auto file = read(read_config(path));
  file.content = read_text_file(path);
  return file;
}

void read_machine(const CampaignInput& input, measurements::MeasurementSet& set) {
  set.kind = rigs::find_machine_kind_if_any(input.rig);
  if (set.kind == nullptr) require_rig(input.rig);
  if (set.kind != nullptr && !set.kind->names_rig()) {
    set.vehicle = read_named("vehicles", input.vehicle, rigs::read_vehicle);
    rigs::share_tire(set.tire, *set.vehicle);
    return;
  }
  set.rig = read_named("rigs", set.kind != nullptr ? set.kind->usual_rig : input.rig,
                       [](const ConfigTable& config) { return rigs::read_rig(config); });
  rigs::use_skim_load_of_class(*set.rig, set.tire);
  set.kind = set.rig->kind;
  if (set.kind->names_rig()) return;
  throw InputError({fmt::format("rig '{}' is a road, where a campaign has a vehicle", set.rig->name), "command line", 0,
                    "--rig", input.rig, "--rig road, with --vehicle", ""});
}

/// The load and the pressure of a usual test of the tire.
std::pair<double, double> find_usual_load(const measurements::MeasurementSet& set) {
  const auto& law = set.tire.values.rolling_resistance;
  const auto& iso = set.tire.iso_28580;
  const bool is_iso = iso.has_value() && !is_of_vehicle(set.kind->traits);
  return {is_iso ? iso->load_N : law.reference_load_N, iso.has_value() ? iso->pressure_Pa : law.reference_pressure_Pa};
}

/// Ten minutes at the usual load and speed. The test menu takes its conditions and the interval of samples from it.
measurements::MeasuredRun make_usual_run(const measurements::MeasurementSet& set) {
  constexpr int kRows = 600;
  constexpr double kUsualSpeed_m_s = 80.0 / 3.6;
  constexpr double kUsualAir_K = 298.15;  // ISO 28580: 25 degC
  const auto [load_N, pressure_Pa] = find_usual_load(set);
  const double ambient_K = set.rig.has_value() ? set.rig->environment.ambient_K : kUsualAir_K;
  measurements::MeasuredRun run;
  run.id = "usual";
  run.session = "usual";
  run.initial_tire_temperature_K = ambient_K;
  run.cold_pressure_Pa = pressure_Pa;
  for (int i = 0; i < kRows; ++i) run.time_s.push_back(i);  // 1 Hz. Assumed
  for (const rigs::Column& column : set.kind->columns.given) run.columns[column.quantity].assign(kRows, 0.0);
  run.columns[quantities::kSpeed].assign(kRows, kUsualSpeed_m_s);
  run.columns[quantities::kAmbient].assign(kRows, ambient_K);
  if (run.has(quantities::kLoad)) run.columns[quantities::kLoad].assign(kRows, load_N);
  for (const auto& [channel, sensor] : set.sensors) run.columns[channel].assign(kRows, 0.0);
  return run;
}

}  // namespace

measurements::MeasurementSet make_usual_set(const CampaignInput& input) {
  measurements::MeasurementSet set;
  set.path = "command line";
  set.name = "campaign";
  set.tire = read_named("tires", input.tire, models::read_tire);
  read_machine(input, set);
  const std::string sensors = input.sensors.empty() ? set.kind->usual_sensors : input.sensors;
  set.sensors =
      measurements::read_sensor_file(read_config(find_asset("sensors", sensors)), rigs::measured_channels(*set.kind));
  set.runs = {make_usual_run(set)};
  return set;
}

}  // namespace rollrig::diagnosis
