#pragma once
/// Logs of a drum run that is made up here, by an integration of its own: nothing of what the import assumes goes in.

#include <cstdint>

#include "measurements/logs/log.h"

namespace rollrig::tests {

struct LogsPlan {
  double shift_s = 0.0;  // torque clock = tire clock + shift + rate * tire clock
  double rate = 0.0;
  double tire_interval_s = 1.0;
  bool tire_has_speed = false;
  bool changes = true;  // of speed and load; else a tire that rolls on for ever
  double noise = 1.0;   // times 0.1 K, 0.05 kPa, 0.3 km/h, 0.25 N m, drift of half as much
};

struct MadeUpLogs {
  measurements::Log torque;
  measurements::Log tire;
  measurements::Mapping mapping;  // for both; a quarter of an hour of search less
};

MadeUpLogs make_up_logs(const LogsPlan& plan, std::uint64_t seed);

/// True shift at a time of the tire log's clock.
double true_shift_s(const LogsPlan& plan, double tire_s);

}  // namespace rollrig::tests
