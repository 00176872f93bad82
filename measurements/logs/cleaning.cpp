#include "measurements/logs/cleaning.h"

#include <algorithm>
#include <limits>

#include "measurements/spikes.h"

namespace rollrig::measurements {

void take_out_spikes(Log& log, const models::SensorSet& sensors, double threshold) {
  constexpr double kFloor = 0.1;  // Assumed: of given columns, in m/s, K or m
  const std::vector<bool> steady = find_steady_rows(log.columns, log.time_s.size());
  const std::vector<bool> all(log.time_s.size(), true);
  for (auto& [quantity, values] : log.columns) {
    const auto sensor = sensors.find(quantity);
    double floor = kFloor;
    if (sensor != sensors.end()) floor = std::max(sensor->second.noise_sd, sensor->second.resolution);
    // Loads and forces jump as they are told to.
    if (quantity == models::quantities::kLoad || quantity == models::quantities::kLongitudinalForce) continue;
    const std::vector<bool>& judged = carries_inertia(quantity) ? steady : all;
    for (const std::size_t row : find_spikes(values, threshold, floor, judged)) {
      log.marks.push_back({log.file, log.line[row], quantity, log.time_s[row], log.time_s[row],
                           quantity.file_unit().from_si(values[row]), "spike"});
      values[row] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace rollrig::measurements
