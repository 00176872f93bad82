#include "measurements/sensor_file.h"

#include <fmt/format.h>

#include "measurements/measurement_set.h"
#include "sim/core/assets.h"

namespace rollrig::measurements {

models::SensorSet read_sensor_file(const ConfigTable& config, const std::vector<Quantity>& channels) {
  TableReader file(config, "");
  check_format(file, "rollrig-sensors", 1);
  file.text("name");
  const ConfigTable* sensors = file.table("sensors");
  if (sensors == nullptr) throw file.problem("sensors", "missing table [sensors]", "[sensors.<channel>] tables");
  file.finish();
  return models::read_sensors(*sensors, channels);
}

models::SensorSet read_sensor_file(const ConfigTable& config) {
  return read_sensor_file(config, rigs::all_measured_channels());
}

models::SensorSet read_sensor_asset(const std::string& name_or_path) {
  return read_sensor_file(read_config(find_asset("sensors", name_or_path)));
}

std::string write_sensors(const models::SensorSet& sensors) {
  std::string text;
  for (const auto& [channel, sensor] : sensors) {
    const double factor = channel.file_unit().factor;
    text += fmt::format(
        "\n[sensors.{}]\noffset_sd = {:.10g}\ndrift_sd = {:.10g}\ndrift_time_s = {:.10g}\nnoise_sd = {:.10g}\n"
        "resolution = {:.10g}\n",
        channel.header(), sensor.offset_sd / factor, sensor.drift_sd / factor, sensor.drift_time_s,
        sensor.noise_sd / factor, sensor.resolution / factor);
  }
  return text;
}

}  // namespace rollrig::measurements
