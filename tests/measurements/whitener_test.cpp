#include "measurements/whitener.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "models/quantities.h"

using namespace rollrig;
using measurements::Whitener;

namespace {
const models::SensorParameters kSensor{0.0, 0.3, 20.0, 0.2, 0.0};

/// Times with gaps: every third sample is missing.
std::vector<double> times_with_gaps(int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    if (i % 3 != 1) times.push_back(i);
  }
  return times;
}
}  // namespace

TEST_CASE("drift and noise become white with unit variance, across gaps as well", "[fast]") {
  const std::vector<double> times = times_with_gaps(90000);
  std::vector<double> noise(times.size(), 0.0);
  models::apply_sensor(kSensor, models::quantities::kDrumTorque, {5, "s", "r"}, times, noise);
  std::vector<double> white = noise;
  Whitener(kSensor, times).apply(white.data(), 1);
  double variance = 0.0, lagged = 0.0;
  for (std::size_t i = 0; i + 1 < white.size(); ++i) {
    variance += white[i] * white[i];
    lagged += white[i] * white[i + 1];
  }
  const auto n = static_cast<double>(white.size());
  CHECK(variance / n == Approx(1.0).margin(5.0 * std::sqrt(2.0 / n)));
  CHECK(std::abs(lagged / n) < 5.0 / std::sqrt(n));
}

TEST_CASE("whitening is linear, column by column", "[fast]") {
  const Whitener whitener(kSensor, times_with_gaps(30));
  const std::size_t n = whitener.size();
  std::vector<double> two_columns(2 * n), first(n), second(n);
  for (std::size_t i = 0; i < n; ++i) {
    first[i] = two_columns[2 * i] = std::sin(static_cast<double>(i));
    second[i] = two_columns[2 * i + 1] = 1.0;
  }
  std::vector<double> both = two_columns, alone = first;
  whitener.apply(both.data(), 2);
  whitener.apply(alone.data(), 1);
  for (std::size_t i = 0; i < n; ++i) CHECK(both[2 * i] == alone[i]);
}

TEST_CASE("the squared length after whitening is r' C^-1 r", "[fast]") {
  // Two samples 5 s apart, worked by hand: C = [[a, b], [b, a]], a = 0.09 + 0.04, b = 0.09 exp(-5/20).
  const Whitener whitener(kSensor, {0.0, 5.0});
  const double r[] = {0.4, -0.1};
  double w[] = {r[0], r[1]};
  whitener.apply(w, 1);
  const double a = 0.13, b = 0.09 * std::exp(-0.25);
  const double expected = (a * r[0] * r[0] - 2.0 * b * r[0] * r[1] + a * r[1] * r[1]) / (a * a - b * b);
  CHECK(w[0] * w[0] + w[1] * w[1] == Approx(expected));
}
