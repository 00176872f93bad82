#pragma once
/// Emulated sensors: session offset, drift, noise, rounding, drop-outs (formats.md, "Sensors").

#include <cstdint>
#include <string>
#include <vector>

namespace rollrig::generator {

/// Error sizes of one channel, in its unit.
struct Sensor {
  double offset_sd = 0.0;
  double drift_sd = 0.0;
  double drift_time_s = 60.0;
  double noise_sd = 0.0;
  double resolution = 0.0;

  /// Standard deviation of a mean over 10 samples at 1 Hz: drift, noise and rounding, without the offset.
  /// Equation  var = sd_drift^2 sum_ij exp(-|i - j| dt/tau)/n^2 + (sd_noise^2 + q^2/12)/n
  double floor() const;
};

/// A measured column, the logger that takes it, and a sensor as laboratories have it.
struct Channel {
  const char* name;
  const char* logger;
  Sensor typical;
};

using Sensors = std::vector<Sensor>;  // one a channel

/// Sensors about the typical ones.
Sensors draw_sensors(std::uint64_t seed, const std::vector<Channel>& channels);
std::string write_sensors(const std::vector<Channel>& channels, const Sensors& sensors);

/// Which random numbers a sensor draws: its offset by the session, the rest by the run.
struct SensorStream {
  std::uint64_t seed = 0;
  std::string session;
  std::string run;
};

/// Turns true values into what the sensor reads.
/// Drift starts stationary in every run and channel and goes on through missing samples; rounding comes last.
void apply_sensor(const Sensor& sensor, const SensorStream& stream, const Channel& channel,
                  const std::vector<double>& time_s, std::vector<double>& values);

/// Takes samples away: single ones, and gaps that temperature and pressure share, since one logger takes both.
void drop_samples(std::uint64_t seed, const std::string& run, const Channel& channel, std::vector<double>& values);

}  // namespace rollrig::generator
