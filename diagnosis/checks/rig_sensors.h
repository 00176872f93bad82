#pragma once
/// Sensors that a rig may be given, and what any channel of a simulated run would read.

#include <vector>

#include "diagnosis/comparison/prepared_set.h"
#include "models/corner.h"
#include "sim/recording.h"

namespace rollrig::diagnosis {

/// A sensor that rigs seldom have and whose reading every hypothesis predicts.
struct RigSensor {
  Quantity channel;  // what it reads
  const char* description;
  double hours = 0.0;              // to fit it
  models::SensorParameters error;  // SI
};

constexpr Quantity kSurfaceReading{"surface_reading", "degC"};

/// Sensors and their errors are Assumed: offsets of thermometers hold the place in which they sit as well (2 K where
/// the baseline has nothing that warms: a rim or a surface that takes no heat stays that near to the air).
/// Not among them: a thermometer in the drum's bearings. They warm under every hypothesis, and only the one whose
/// friction follows their temperature says how far.
const std::vector<RigSensor>& all_rig_sensors();
/// Throws std::invalid_argument where there is none of that channel.
const RigSensor& find_rig_sensor(const Quantity& channel);

/// A channel of a run as a sensor would read it, a value a row.
/// Validity  the force as measurements::read_force() reads it; sensors other than the channels of `source`: full detail
/// Checked   tests/diagnosis/next_test_test.cpp
template <class S>
std::vector<S> read_channel(const measurements::MeasurementSet& source, const measurements::MeasuredRun& run,
                            const models::Corner<S>& corner, const sim::Recording<S>& recording,
                            const Quantity& channel);

}  // namespace rollrig::diagnosis
