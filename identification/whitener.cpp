#include "identification/whitener.h"

#include <cmath>

namespace rollrig::identification {

Whitener::Whitener(const models::SensorParameters& sensor, const std::vector<double>& time_s) {
  const double drift_variance = sensor.drift_sd * sensor.drift_sd;
  const double white_variance = sensor.noise_sd * sensor.noise_sd + sensor.resolution * sensor.resolution / 12.0;
  double variance = drift_variance;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    double memory = 0.0;
    if (k > 0) {
      memory = std::exp(-(time_s[k] - time_s[k - 1]) / sensor.drift_time_s);
      variance = memory * memory * variance + drift_variance * (1.0 - memory * memory);
    }
    const double innovation_variance = variance + white_variance;
    const double gain = variance / innovation_variance;
    memory_.push_back(memory);
    gain_.push_back(gain);
    inverse_.push_back(1.0 / std::sqrt(innovation_variance));
    variance *= 1.0 - gain;
  }
}

void Whitener::apply(const double* in, std::size_t count, double* out) const {
  std::vector<double> drift(count, 0.0);
  for (std::size_t k = 0; k < size(); ++k) {
    for (std::size_t c = 0; c < count; ++c) {
      const double predicted = memory_[k] * drift[c];
      const double innovation = in[k * count + c] - predicted;
      out[k * count + c] = innovation * inverse_[k];
      drift[c] = predicted + gain_[k] * innovation;
    }
  }
}

}  // namespace rollrig::identification
