#include "rollrig/measurement_set.h"

#include "api/data.h"
#include "diagnosis/output/fleet.h"

namespace rollrig {

MeasurementSet::MeasurementSet(const std::string& folder)
    : data_(std::make_shared<const Data>(Data{measurements::read_measurement_set(folder)})) {}

const std::string& MeasurementSet::name() const { return data_->set.name; }
std::string MeasurementSet::kind() const { return data_->set.kind->word; }
const std::string& MeasurementSet::tire() const { return data_->set.tire.name; }

std::vector<MeasuredRun> MeasurementSet::list_runs() const {
  std::vector<MeasuredRun> runs;
  for (const measurements::MeasuredRun& run : data_->set.runs) {
    runs.push_back(
        {run.id, run.session, run.initial_tire_temperature_K, run.cold_pressure_Pa, run.rest_before_s, run.time_s, {}});
    for (const auto& [name, values] : run.columns) {
      runs.back().columns.push_back(make_channel(name, values));
    }
  }
  return runs;
}

std::vector<std::string> find_sets(const std::string& folder) { return diagnosis::find_sets(folder); }

std::vector<std::string> find_undescribed_folders(const std::string& folder) {
  return diagnosis::find_undescribed_folders(folder);
}

}  // namespace rollrig
