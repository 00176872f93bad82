#include "rollrig/measurement_set.h"

#include <algorithm>
#include <filesystem>

#include "api/data.h"

namespace fs = std::filesystem;

namespace rollrig {

MeasurementSet::MeasurementSet(const std::string& folder, BadRows bad_rows)
    : data_(std::make_shared<const Data>(Data{measurements::read_measurement_set(folder, bad_rows)})) {}

const std::string& MeasurementSet::name() const { return data_->set.name; }
std::string MeasurementSet::kind() const { return data_->set.kind->set_word; }
const std::string& MeasurementSet::tire() const { return data_->set.tire.name; }

std::vector<MeasuredRun> MeasurementSet::list_runs() const {
  std::vector<MeasuredRun> runs;
  for (const measurements::MeasuredRun& run : data_->set.runs) {
    runs.push_back(
        {run.id, run.session, run.initial_tire_temperature_K, run.cold_pressure_Pa, run.rest_before_s, run.time_s, {}});
    for (const auto& [quantity, values] : run.columns) {
      runs.back().columns.push_back(make_channel(quantity, values));
    }
  }
  return runs;
}

std::vector<std::string> find_sets(const std::string& folder) {
  std::vector<std::string> sets;
  if (!fs::is_directory(folder) || fs::exists(fs::path(folder) / "set.toml")) return sets;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "set.toml")) sets.push_back(entry.path().string());
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

std::vector<std::string> find_undescribed_folders(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() || fs::exists(entry.path() / "set.toml")) continue;
    const fs::directory_iterator files(entry.path());
    const bool has_csv =
        std::any_of(begin(files), end(files), [](const auto& file) { return file.path().extension() == ".csv"; });
    if (has_csv) found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace rollrig
