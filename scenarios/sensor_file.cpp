#include "scenarios/sensor_file.h"

#include "scenarios/assets.h"
#include "scenarios/measurement_set.h"

namespace rollrig::scenarios {

models::SensorSet read_sensor_file(const ConfigTable& config, const std::vector<std::string>& channels) {
  TableReader file(config, "");
  check_format(file, "rollrig-sensors", 1);
  file.text("name");
  const ConfigTable* sensors = file.table("sensors");
  if (sensors == nullptr) throw file.problem("sensors", "missing table [sensors]", "[sensors.<channel>] tables");
  file.finish();
  return models::read_sensors(*sensors, channels);
}

models::SensorSet read_sensor_file(const ConfigTable& config) {
  return read_sensor_file(config, all_measured_channels());
}

models::SensorSet read_sensor_asset(const std::string& name_or_path) {
  return read_sensor_file(read_config(find_asset("sensors", name_or_path)));
}

}  // namespace rollrig::scenarios
