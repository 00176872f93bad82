#pragma once
/// At which speeds and loads a measured tire rolls, as far as they decide numbers of its law.

#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::estimation {

/// Whether a set has several speeds and several loads: values that differ by a tenth.
struct Variety {
  bool speeds = false;
  bool loads = false;
};

/// Speeds below 20 km/h and loads below a fifth of the reference load do not count, nor does what lasts less than a
/// minute or 5 % of the time, so that ramps and noise are no values of their own.
Variety find_variety(const measurements::MeasurementSet& set);

/// Loads at which the set rolls for a minute at least. Near ones (2 %) are one.
std::vector<double> find_loads_N(const measurements::MeasurementSet& set);

/// Conditions of the loaded tire at one speed, means over time.
struct SpeedConditions {
  double speed_m_s = 0.0;
  double load_N = 0.0;
  double pressure_Pa = 0.0;    // as measured; else that of the cold tire
  double temperature_K = 0.0;  // of the liner as measured; else 30 degC
};

/// Speeds from 20 km/h at which the loaded tire rolls for a minute and 5 % of the time at least. Near ones (2 %) are
/// one.
std::vector<SpeedConditions> find_speeds(const measurements::MeasurementSet& set);

}  // namespace rollrig::estimation
