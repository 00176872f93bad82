#pragma once
/// What objects of the API hold, and what its results are made with.

#include "measurements/measurement_set.h"
#include "rollrig/measurement_set.h"
#include "sim/core/json.h"

namespace rollrig {

struct MeasurementSet::Data {
  measurements::MeasurementSet set;
};

/// Values in SI units as a channel of the API has them.
Channel make_channel(const Quantity& quantity, std::vector<double> values_SI);

}  // namespace rollrig
