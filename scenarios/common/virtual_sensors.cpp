#include "scenarios/common/virtual_sensors.h"

namespace rollrig::scenarios {

void apply_sensors(const RunSpec& spec, sim::Recording<double>& recording) {
  if (!spec.sensors.has_value()) return;
  for (const auto& [channel, sensor] : *spec.sensors) {
    models::apply_sensor(sensor, channel, {spec.seed, "session", "run"}, recording.time_s, recording.channel(channel));
  }
}

}  // namespace rollrig::scenarios
