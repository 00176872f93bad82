#pragma once
/// Whitening of a residual whose noise is first-order autoregressive drift and white noise.

#include <vector>

#include "models/sensor.h"

namespace rollrig::identification {

/// Turns samples with the sensor's drift, noise and rounding (not its offset) into independent ones of
/// unit variance, by a scalar Kalman filter on the drift. The filter's gains depend on the times alone,
/// so the same linear map whitens a residual and the columns of its Jacobian.
///
/// Equation  d_k = rho d_{k-1} + w,  r_k = d_k + e;  out_k = (r_k - d_k|k-1) / sqrt(P_k|k-1 + R),
///           rho = exp(-dt/tau), var w = sd_drift^2 (1 - rho^2), R = sd_noise^2 + q^2/12
/// Checked   tests/identification/whitener_test.cpp
class Whitener {
 public:
  /// `time_s` of the samples that are there, increasing.
  Whitener(const models::SensorParameters& sensor, const std::vector<double>& time_s);

  std::size_t size() const { return gain_.size(); }
  /// Whitens `count` columns at once; row k of column c is in[k * count + c].
  void apply(const double* in, std::size_t count, double* out) const;

 private:
  std::vector<double> memory_;   // rho from the sample before
  std::vector<double> gain_;     // of the innovation on the drift
  std::vector<double> inverse_;  // 1/sqrt(innovation variance)
};

}  // namespace rollrig::identification
