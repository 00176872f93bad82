#pragma once
/// Errors of a sensor: how they are made, and how large the error of a mean is.

#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/quantity.h"
#include "sim/core/schema.h"

namespace rollrig::models {

/// Error model of one measured channel, all in SI units of the channel (a temperature's are differences).
///
/// measured = round(true + offset + drift + noise); offset constant over a session; drift a stationary
/// first-order autoregressive process; noise white; rounding to the resolution comes last.
/// Source    formats.md, "Measurement set"
struct SensorParameters {
  double offset_sd = 0.0;
  double drift_sd = 0.0;
  double drift_time_s = 1.0;
  double noise_sd = 0.0;
  double resolution = 0.0;  // 0 for none
};

/// Sensors by the channel that they measure.
using SensorSet = QuantityMap<SensorParameters>;

/// Reads [sensors.<channel>] tables; channels must be among `known`. Throws InputError.
SensorSet read_sensors(const ConfigTable& sensors, const std::vector<Quantity>& known);

/// Which random numbers a sensor draws: runs of one session share the offset.
struct SensorStream {
  std::uint64_t seed = 0;
  std::string session;
  std::string run;
};

/// Adds the errors of a sensor to samples at increasing times; NaN stays NaN.
void apply_sensor(const SensorParameters& sensor, const Quantity& channel, const SensorStream& stream,
                  const std::vector<double>& time_s, std::vector<double>& values);

/// Variance of the difference of two means over `count` samples each, their starts `apart_s` apart, in
/// one session: the offset cancels.
/// Equation  var = 2 var_mean(drift) - 2 cov(drift) + 2 (noise^2 + q^2/12)/n, drift by its
///           autocorrelation exp(-|dt|/tau)
double calc_difference_variance(const SensorParameters& sensor, int count, double interval_s, double apart_s);

}  // namespace rollrig::models
