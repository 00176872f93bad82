#pragma once
/// assets/sensors/<name>.toml: presets of virtual sensors.

#include <string>
#include <vector>

#include "models/sensor.h"

namespace rollrig::measurements {

/// Reads a preset ("rollrig-sensors/1") by name or path. Throws InputError.
models::SensorSet read_sensor_asset(const std::string& name_or_path);
/// Reads a preset from parsed TOML; its channels must be among `channels`, by default those of any rig.
models::SensorSet read_sensor_file(const ConfigTable& config, const std::vector<Quantity>& channels);
models::SensorSet read_sensor_file(const ConfigTable& config);

}  // namespace rollrig::measurements
