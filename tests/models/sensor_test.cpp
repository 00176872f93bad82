#include "models/sensor.h"
#include "models/quantities.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace rollrig;
using models::SensorParameters;

namespace {
std::vector<double> seconds(std::size_t count) {
  std::vector<double> times(count);
  std::iota(times.begin(), times.end(), 0.0);
  return times;
}
std::vector<double> errors(const SensorParameters& sensor, const models::SensorStream& stream, std::size_t count,
                           const Quantity& channel = models::quantities::kDrumTorque) {
  std::vector<double> values(count, 0.0);
  models::apply_sensor(sensor, channel, stream, seconds(count), values);
  return values;
}
double mean(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}
}  // namespace

TEST_CASE("a sensor without errors changes nothing", "[fast]") {
  for (const double e : errors({}, {1, "s", "r"}, 10)) CHECK(e == 0.0);
}

TEST_CASE("runs of one session share the offset and nothing else", "[fast]") {
  const SensorParameters offset_only{0.45, 0.0, 1.0, 0.0, 0.0};
  CHECK(errors(offset_only, {1, "day", "a"}, 3) == errors(offset_only, {1, "day", "b"}, 3));
  CHECK(errors(offset_only, {1, "day", "a"}, 3) != errors(offset_only, {1, "night", "a"}, 3));
  const SensorParameters noise_only{0.0, 0.0, 1.0, 0.25, 0.0};
  CHECK(errors(noise_only, {1, "day", "a"}, 3) != errors(noise_only, {1, "day", "b"}, 3));
  CHECK(errors(noise_only, {1, "day", "a"}, 3) == errors(noise_only, {1, "day", "a"}, 3));
}

TEST_CASE("drift is stationary with the standard deviation and memory that were asked for", "[fast]") {
  const SensorParameters drift{0.0, 0.1, 60.0, 0.0, 0.0};
  const std::vector<double> d = errors(drift, {3, "s", "r"}, 200000);
  double variance = 0.0, lagged = 0.0;
  for (std::size_t i = 0; i + 60 < d.size(); ++i) {
    variance += d[i] * d[i];
    lagged += d[i] * d[i + 60];
  }
  CHECK(std::sqrt(variance / static_cast<double>(d.size())) == Approx(0.1).epsilon(0.05));
  CHECK(lagged / variance == Approx(std::exp(-1.0)).margin(0.06));
}

TEST_CASE("readings are whole steps in the unit that is shown", "[fast]") {
  std::vector<double> kelvin{298.15 + 0.04, 298.15 + 0.06};
  models::apply_sensor({0.0, 0.0, 1.0, 0.0, 0.1}, models::quantities::kLinerTemperature, {1, "s", "r"}, {0.0, 1.0},
                       kelvin);
  CHECK(kelvin[0] - 273.15 == Approx(25.0).margin(1e-9));
  CHECK(kelvin[1] - 273.15 == Approx(25.1).margin(1e-9));
}

TEST_CASE("the variance of a difference of means is what a thousand sensors show", "[fast]") {
  const SensorParameters sensor{0.45, 0.1, 60.0, 0.25, 0.0};
  constexpr int kCount = 60, kApart = 180, kSensors = 2000;
  double squares = 0.0;
  for (int seed = 0; seed < kSensors; ++seed) {
    const std::vector<double> e = errors(sensor, {static_cast<std::uint64_t>(seed), "s", "r"}, kApart + kCount);
    const double difference = mean({e.begin(), e.begin() + kCount}) - mean({e.begin() + kApart, e.end()});
    squares += difference * difference;
  }
  const double expected = models::calc_difference_variance(sensor, kCount, 1.0, kApart);
  CHECK(squares / kSensors == Approx(expected).epsilon(5.0 * std::sqrt(2.0 / kSensors)));
}

TEST_CASE("the offset cancels in a difference, and windows far apart forget each other's drift", "[fast]") {
  const SensorParameters offset_only{0.45, 0.0, 60.0, 0.0, 0.0};
  CHECK(models::calc_difference_variance(offset_only, 60, 1.0, 180.0) == 0.0);
  const SensorParameters drift{0.0, 0.1, 60.0, 0.0, 0.0};
  CHECK(models::calc_difference_variance(drift, 60, 1.0, 10.0) < models::calc_difference_variance(drift, 60, 1.0, 1e6));
  CHECK(models::calc_difference_variance(drift, 1, 1.0, 1e6) == Approx(2.0 * 0.01));
}
