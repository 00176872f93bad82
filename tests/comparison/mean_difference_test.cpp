// Intervals of means of samples that are correlated from one to the next hold the true mean as often as they say.
#include "comparison/mean_difference.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using rollrig::comparison::add_zeros;
using rollrig::comparison::calc_block_mean;
using rollrig::comparison::calc_mean;
using rollrig::comparison::calc_sensor_mean_sd;
using rollrig::comparison::UncertainMean;
using rollrig::models::SensorParameters;

namespace {

/// Samples a second apart of a sensor that reads 0, but for offset and resolution.
std::vector<double> draw_samples(const SensorParameters& sensor, std::size_t count, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double keeps = std::exp(-1.0 / sensor.drift_time_s);
  double drift = sensor.drift_sd * normal(random);
  std::vector<double> samples;
  for (std::size_t i = 0; i < count; ++i) {
    samples.push_back(drift + sensor.noise_sd * normal(random));
    drift = keeps * drift + sensor.drift_sd * std::sqrt(1.0 - keeps * keeps) * normal(random);
  }
  return samples;
}

/// Share of intervals that hold the true mean, 0.
double find_coverage(const SensorParameters& sensor, std::size_t count, bool knows_sensor) {
  constexpr int kTrials = 2000;
  std::mt19937_64 random(7);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<double> samples = draw_samples(sensor, count, random);
    const UncertainMean found = calc_mean(samples, knows_sensor ? calc_sensor_mean_sd(sensor, count, 1.0) : 0.0);
    if (std::abs(found.mean) <= found.coverage_factor * *found.sd) ++held;
  }
  return static_cast<double>(held) / kTrials;
}

}  // namespace

// 2000 trials know the share to 0.005. Blocks of 225 s are 22 correlation times long.
TEST_CASE("intervals from the scatter alone cover 95 % where blocks are long against the correlation", "[slow]") {
  CHECK(find_coverage({0.0, 0.0, 1.0, 0.25, 0.0}, 600, false) == Approx(0.95).margin(0.02));
  CHECK(find_coverage({0.0, 0.25, 10.0, 0.25, 0.0}, 1800, false) == Approx(0.95).margin(0.02));
}

// Blocks of 75 s with a drift of 60 s show only a part of it: 0.80 by the scatter alone.
TEST_CASE("a stretch that is short against the drift of its sensor has the interval of the sensor at least", "[slow]") {
  const SensorParameters drifting{0.0, 0.1, 60.0, 0.25, 0.0};
  CHECK(find_coverage(drifting, 600, false) < 0.90);
  CHECK(find_coverage(drifting, 600, true) >= 0.94);
  CHECK(find_coverage(drifting, 60, true) >= 0.94);
}

TEST_CASE("a straight trend is no scatter", "[fast]") {
  std::mt19937_64 random(3);
  std::vector<double> samples = draw_samples({0.0, 0.0, 1.0, 0.1, 0.0}, 800, random);
  const UncertainMean still = calc_block_mean(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] += 0.01 * static_cast<double>(i);
  const UncertainMean rising = calc_block_mean(samples);
  CHECK(*rising.sd == Approx(*still.sd).epsilon(1e-9));                     // rounding
  CHECK(rising.mean == Approx(still.mean + 0.01 * 799 / 2).epsilon(1e-9));  // the mean of the line
}

TEST_CASE("zeros of sensors widen an interval, and count alone where nothing scatters", "[fast]") {
  const UncertainMean mean{5.0, 0.3, 2.4};
  const UncertainMean both = add_zeros(mean, 0.4);
  CHECK(both.mean == 5.0);
  CHECK(*both.sd == Approx(0.5));
  const double half = both.coverage_factor * *both.sd;
  CHECK(half > 2.4 * 0.3);
  CHECK(half < 2.4 * 0.3 + 1.96 * 0.4);
  const UncertainMean alone = add_zeros({5.0, 1e-9, 2.4}, 0.4);
  CHECK(alone.coverage_factor * *alone.sd == Approx(1.96 * 0.4).epsilon(1e-3));
  CHECK(*add_zeros(mean, 0.0).sd == 0.3);
}

TEST_CASE("a few samples have a mean and no interval", "[fast]") {
  const UncertainMean found = calc_mean({1.0, 2.0, 3.0}, 0.1);
  CHECK(found.mean == Approx(2.0));
  CHECK_FALSE(found.sd.has_value());
}
