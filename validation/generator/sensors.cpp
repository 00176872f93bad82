#include "validation/generator/sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/generator/draws.h"

namespace rollrig::generator {
namespace {

double round_to_step(double value, double step) { return std::round(value / step) * step; }

}  // namespace

double Sensor::floor() const {
  constexpr int kSamples = 10;
  double shared = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    for (int j = 0; j < kSamples; ++j) shared += std::exp(-std::abs(i - j) / drift_time_s);
  }
  const double white = noise_sd * noise_sd + resolution * resolution / 12.0;
  return std::sqrt(drift_sd * drift_sd * shared / (kSamples * kSamples) + white / kSamples);
}

Sensors draw_sensors(std::uint64_t seed, const std::vector<Channel>& channels) {
  Draws draws(seed, "sensors");
  const auto varied = [&draws](double value) { return round_to_step(value * draws.uniform(0.75, 1.3), 0.001); };
  Sensors sensors;
  for (const Channel& channel : channels) {
    const Sensor& typical = channel.typical;
    Sensor sensor;
    sensor.offset_sd = varied(typical.offset_sd);
    sensor.drift_sd = varied(typical.drift_sd);
    sensor.drift_time_s = std::round(typical.drift_time_s * draws.uniform(0.75, 1.3));
    sensor.noise_sd = varied(typical.noise_sd);
    sensor.resolution = typical.resolution;
    sensors.push_back(sensor);
  }
  return sensors;
}

std::string write_sensors(const std::vector<Channel>& channels, const Sensors& sensors) {
  std::string text;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const Sensor& sensor = sensors[i];
    text += fmt::format(
        "\n[sensors.{}]\noffset_sd = {:.10g}\ndrift_sd = {:.10g}\ndrift_time_s = {:.10g}\nnoise_sd = {:.10g}\n"
        "resolution = {:.10g}\n",
        channels[i].name, sensor.offset_sd, sensor.drift_sd, sensor.drift_time_s, sensor.noise_sd, sensor.resolution);
  }
  return text;
}

void apply_sensor(const Sensor& sensor, const SensorStream& stream, const Channel& channel,
                  const std::vector<double>& time_s, std::vector<double>& values) {
  Draws offsets(stream.seed, fmt::format("offset/{}/{}", stream.session, channel.name));
  Draws drifts(stream.seed, fmt::format("drift/{}/{}", stream.run, channel.name));
  Draws noises(stream.seed, fmt::format("noise/{}/{}", stream.run, channel.name));
  const double offset = sensor.offset_sd * offsets.normal();
  double drift = sensor.drift_sd * drifts.normal();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) {
      const double kept = std::exp(-(time_s[i] - time_s[i - 1]) / sensor.drift_time_s);
      drift = kept * drift + sensor.drift_sd * std::sqrt(1.0 - kept * kept) * drifts.normal();
    }
    values[i] += offset + drift + sensor.noise_sd * noises.normal();
    if (sensor.resolution > 0.0) values[i] = round_to_step(values[i], sensor.resolution);
  }
}

void drop_samples(std::uint64_t seed, const std::string& run, const Channel& channel, std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Draws singles(seed, fmt::format("dropped/{}/{}", run, channel.name));
  for (double& value : values) {
    if (singles.happens(0.003)) value = kNone;
  }
  Draws gaps(seed, fmt::format("gaps/{}/{}", run, channel.logger));
  const int count = gaps.whole(0, 3);
  const int last = static_cast<int>(values.size()) - 1;
  for (int i = 0; i < count; ++i) {
    const int first = gaps.whole(0, last);
    const int length = gaps.whole(3, 60);
    for (int row = first; row <= std::min(last, first + length); ++row) values[static_cast<std::size_t>(row)] = kNone;
  }
}

}  // namespace rollrig::generator
