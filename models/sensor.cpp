#include "models/sensor.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/random.h"

namespace rollrig::models {
namespace {

SensorParameters read_sensor(TableReader& reader, const Quantity& channel) {
  SensorParameters sensor;
  constexpr double kMost = 1e6;                       // Assumed: in any unit of a channel, no sensor is so bad
  constexpr Range kDriftTime_s = between(1e-3, 1e9);  // Assumed: from a millisecond to 30 years

  // A standard deviation in the unit of the channel is a difference: the factor without the offset.
  const auto in_channel_unit = [&](const char* key, const char* doc) {
    return reader.number({key, between(0.0, kMost), doc}) * channel.file_unit().factor;
  };
  sensor.offset_sd = in_channel_unit("offset_sd", "constant over a session");
  sensor.drift_sd = in_channel_unit("drift_sd", "first-order autoregressive drift");
  sensor.drift_time_s = reader.number({"drift_time_s", kDriftTime_s, "its time constant"});
  sensor.noise_sd = in_channel_unit("noise_sd", "white, per sample");
  sensor.resolution = in_channel_unit("resolution", "quantization step, 0 for none");
  reader.finish();
  return sensor;
}

}  // namespace

SensorSet read_sensors(const ConfigTable& sensors, const std::vector<Quantity>& known) {
  SensorSet set;
  TableReader reader(sensors, "[sensors]");
  for (const std::string& header : sensors.keys()) {
    const auto channel = std::find_if(known.begin(), known.end(),
                                      [&header](const Quantity& quantity) { return quantity.header() == header; });
    if (channel == known.end()) {
      InputProblem problem = unknown_name("measured channel", header, list_headers(known));
      problem.file = sensors.find(header)->origin.file;
      problem.line = sensors.find(header)->origin.line;
      problem.key = fmt::format("[sensors.{}]", header);
      throw InputError(problem);
    }
    TableReader own(*reader.table(header), fmt::format("[sensors.{}]", header));
    set[*channel] = read_sensor(own, *channel);
  }
  return set;
}

void apply_sensor(const SensorParameters& sensor, const Quantity& channel, const SensorStream& stream,
                  const std::vector<double>& time_s, std::vector<double>& values) {
  const std::string header = channel.header();  // part of the streams' names
  RandomStream offsets(stream.seed, "offset/" + stream.session + "/" + header);
  RandomStream drifts(stream.seed, "drift/" + stream.run + "/" + header);
  RandomStream noises(stream.seed, "noise/" + stream.run + "/" + header);
  const double offset = sensor.offset_sd * offsets.normal();
  double drift = sensor.drift_sd * drifts.normal();
  const double zero = channel.file_unit().offset_SI;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) {
      const double memory = std::exp(-(time_s[i] - time_s[i - 1]) / sensor.drift_time_s);
      drift = memory * drift + sensor.drift_sd * std::sqrt(1.0 - memory * memory) * drifts.normal();
    }
    values[i] += offset + drift + sensor.noise_sd * noises.normal();
    if (sensor.resolution > 0.0) {
      // Rounded in the unit that is shown: for a temperature in K the zero of degC is a whole number of steps.
      values[i] = zero + std::round((values[i] - zero) / sensor.resolution) * sensor.resolution;
    }
  }
}

double calc_difference_variance(const SensorParameters& sensor, int count, double interval_s, double apart_s) {
  const auto mean_covariance = [&](double shift_s) {
    double sum = 0.0;
    for (int lag = -(count - 1); lag <= count - 1; ++lag) {
      const double distance_s = std::abs(shift_s + lag * interval_s);
      sum += (count - std::abs(lag)) * std::exp(-distance_s / sensor.drift_time_s);
    }
    return sensor.drift_sd * sensor.drift_sd * sum / (static_cast<double>(count) * count);
  };
  const double white = sensor.noise_sd * sensor.noise_sd + sensor.resolution * sensor.resolution / 12.0;
  return 2.0 * mean_covariance(0.0) - 2.0 * mean_covariance(apart_s) + 2.0 * white / count;
}

}  // namespace rollrig::models
