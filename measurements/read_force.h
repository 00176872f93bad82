#pragma once
/// What the force sensor of a machine reads where weights hang on it, and in reversed rotation.

#include "measurements/measurement_set.h"
#include "models/corner.h"

namespace rollrig::measurements {

/// Known force or torque that hangs on the sensor in each row, in the unit of its channel; nullptr where none does.
const std::vector<double>* find_hung(const MeasuredRun& run);

/// The force channel of a run as its sensor reads it, a value a row.
/// Equation  with weights hung on it  y + trace(hung) - trace(0);  in reversed rotation  y - 2 trace(0)
/// Symbols   y the channel as simulated, trace() what the effects of the port "trace" make of a true force
/// Validity  while weights hang next to nothing else turns the sensor; those effects turn over with the force but for
///           what they make of none
/// Checked   tests/diagnosis/next_sensor_test.cpp, tests/diagnosis/next_test_test.cpp
template <class S>
std::vector<S> read_force(const MeasuredRun& run, const models::Corner<S>& corner, std::vector<S> values,
                          const Quantity& channel);

}  // namespace rollrig::measurements
