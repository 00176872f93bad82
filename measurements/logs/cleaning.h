#pragma once
/// Spikes of a log, found and taken out.

#include "measurements/logs/log.h"
#include "models/sensor.h"

namespace rollrig::measurements {

/// Marks and takes out the spikes of all columns. Columns that carry inertia (torque, forces) are judged only where
/// the log's speed and load are steady.
void take_out_spikes(Log& log, const models::SensorSet& sensors, double threshold);

}  // namespace rollrig::measurements
