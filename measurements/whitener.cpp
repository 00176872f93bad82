#include "measurements/whitener.h"

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <cmath>

namespace rollrig::measurements {
namespace {

/// What a block makes of the drift before it.
struct DriftOverBlock {
  double mean_share = 0.0;  // a
  double end_share = 1.0;   // phi
  double mean_variance = 0.0;
  double end_variance = 0.0;
  double covariance = 0.0;
};

DriftOverBlock follow_drift(const models::SensorParameters& sensor, const std::vector<double>& time_s,
                            const Block& block) {
  const double stationary = sensor.drift_sd * sensor.drift_sd;
  DriftOverBlock drift;  // of the sum, made a mean at the end
  for (std::size_t i = block.first; i < block.last; ++i) {
    const double rho = i == 0 ? 0.0 : std::exp(-(time_s[i] - time_s[i - 1]) / sensor.drift_time_s);
    drift.end_share *= rho;
    drift.end_variance = rho * rho * drift.end_variance + stationary * (1.0 - rho * rho);
    drift.covariance *= rho;  // of the sum so far with this sample
    drift.mean_variance += 2.0 * drift.covariance + drift.end_variance;
    drift.covariance += drift.end_variance;
    drift.mean_share += drift.end_share;
  }
  const auto count = static_cast<double>(block.last - block.first);
  drift.mean_share /= count;
  drift.mean_variance /= count * count;
  drift.covariance /= count;
  return drift;
}

std::vector<Block> make_single_blocks(std::size_t count) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < count; ++i) blocks.push_back({i, i + 1});
  return blocks;
}

}  // namespace

double calc_lasting_rounding_variance(double resolution, double noise_sd) {
  constexpr double kPi = boost::math::constants::pi<double>();
  if (resolution <= 0.0) return 0.0;
  if (noise_sd <= 0.0) return resolution * resolution / 12.0;
  double sum = 0.0;
  for (int k = 1; k <= 1000; ++k) {
    const double turns = 2.0 * kPi * k * noise_sd / resolution;
    const double term = std::exp(-turns * turns) / (2.0 * kPi * kPi * k * k);
    sum += term;
    if (term < 1e-9 * sum || term == 0.0) break;
  }
  return resolution * resolution * sum;
}

ReadingNoise find_reading_noise(const models::SensorParameters& sensor) {
  const double lasting = calc_lasting_rounding_variance(sensor.resolution, sensor.noise_sd);
  const double single = sensor.noise_sd * sensor.noise_sd + sensor.resolution * sensor.resolution / 12.0;
  return {std::max(0.0, single - lasting), lasting};
}

models::SensorParameters average_sensor(models::SensorParameters sensor, double samples) {
  sensor.noise_sd = std::sqrt(find_reading_noise(sensor).calc_mean_variance(samples));
  sensor.resolution = 0.0;
  return sensor;
}

Whitener::Whitener(const models::SensorParameters& sensor, const std::vector<double>& time_s)
    : Whitener(sensor, time_s, make_single_blocks(time_s.size())) {}

Whitener::Whitener(const models::SensorParameters& sensor, const std::vector<double>& time_s,
                   const std::vector<Block>& blocks) {
  const double stationary = sensor.drift_sd * sensor.drift_sd;
  const ReadingNoise noise = find_reading_noise(sensor);
  double variance = stationary;  // of the drift before the block, given all earlier blocks
  for (const Block& block : blocks) {
    const DriftOverBlock drift = follow_drift(sensor, time_s, block);
    const double reading = noise.calc_mean_variance(static_cast<double>(block.last - block.first));
    const double innovation = drift.mean_share * drift.mean_share * variance + drift.mean_variance + reading;
    Step step;
    step.memory = drift.mean_share;
    step.carry = drift.end_share;
    step.gain = (drift.end_share * drift.mean_share * variance + drift.covariance) / innovation;
    step.inverse = 1.0 / std::sqrt(innovation);
    step.alone_sd = std::sqrt(drift.mean_share * drift.mean_share * stationary + drift.mean_variance + reading);
    steps_.push_back(step);
    variance = drift.end_share * drift.end_share * variance + drift.end_variance - step.gain * step.gain * innovation;
  }
}

double Whitener::log_determinant() const {
  double sum = 0.0;
  for (const Step& step : steps_) sum -= 2.0 * std::log(step.inverse);
  return sum;
}

std::size_t Whitener::find_reach(std::size_t end) const {
  constexpr double kNothing = 1e-13;
  double drift = end > 0 ? steps_[end - 1].gain : 0.0;  // that a unit in the last row leaves behind
  while (end < steps_.size() && std::abs(drift) > kNothing) {
    drift *= steps_[end].carry - steps_[end].gain * steps_[end].memory;
    ++end;
  }
  return end;
}

void Whitener::apply_from(std::size_t first, double* values, Shape shape) const {
  std::vector<double> drift(shape.columns, 0.0);
  for (std::size_t k = 0; k < shape.rows; ++k) {
    const Step& step = steps_[first + k];
    for (std::size_t c = 0; c < shape.columns; ++c) {
      double& value = values[k * shape.columns + c];
      const double innovation = value - step.memory * drift[c];
      drift[c] = step.carry * drift[c] + step.gain * innovation;
      value = innovation * step.inverse;
    }
  }
}

void Whitener::undo(double* values, std::size_t count) const {
  std::vector<double> drift(count, 0.0);
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    for (std::size_t c = 0; c < count; ++c) {
      double& value = values[k * count + c];
      const double innovation = value / step.inverse;
      value = innovation + step.memory * drift[c];
      drift[c] = step.carry * drift[c] + step.gain * innovation;
    }
  }
}

}  // namespace rollrig::measurements
