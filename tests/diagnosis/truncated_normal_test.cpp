#include "diagnosis/comparison/truncated_normal.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using rollrig::diagnosis::calc_log_mass;
using rollrig::diagnosis::find_spread;
using rollrig::diagnosis::TruncatedNormal;
using rollrig::diagnosis::TruncatedSpread;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Density between the limits at the middles of fine steps, not normalized.
struct Grid {
  explicit Grid(const TruncatedNormal& of) {
    constexpr int kSteps = 200000;
    const double likeliest = std::fmin(std::fmax(of.mean, of.lower), of.upper);
    const double lower = std::fmax(of.lower, likeliest - 12.0 * of.sd);
    const double upper = std::fmin(of.upper, likeliest + 12.0 * of.sd);
    const double step = (upper - lower) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double x = lower + (i + 0.5) * step;
      const double from_mean = (x - of.mean) / of.sd;
      const double nearest = std::fmax(0.0, std::fmax(lower - of.mean, of.mean - upper) / of.sd);
      points.push_back(x);
      weights.push_back(step * std::exp(-0.5 * (from_mean * from_mean - nearest * nearest)));
    }
  }
  double sum(double from, double to) const {
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] >= from && points[i] <= to) total += weights[i];
    }
    return total;
  }
  double find_sd() const {
    double total = 0.0;
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) total += weights[i];
    for (std::size_t i = 0; i < points.size(); ++i) mean += weights[i] * points[i] / total;
    for (std::size_t i = 0; i < points.size(); ++i) square += weights[i] * std::pow(points[i] - mean, 2) / total;
    return std::sqrt(square);
  }

  std::vector<double> points;
  std::vector<double> weights;
};

}  // namespace

TEST_CASE("without limits the interval is that of a normal distribution", "[fast]") {
  const TruncatedSpread spread = find_spread({3.0, 2.0, -kInfinity, kInfinity});
  CHECK(spread.sd == Approx(2.0));
  CHECK(spread.low_95 == Approx(3.0 - 1.96 * 2.0).epsilon(1e-4));
  CHECK(spread.high_95 == Approx(3.0 + 1.96 * 2.0).epsilon(1e-4));
  CHECK(calc_log_mass({3.0, 2.0, -kInfinity, kInfinity}) == Approx(0.0).margin(1e-12));
  CHECK(calc_log_mass({3.0, 2.0, 3.0, kInfinity}) == Approx(std::log(0.5)));
}

TEST_CASE("an interval at a limit holds 95 %, is the shortest that does, and does not pass the limit", "[fast]") {
  std::mt19937_64 random(20);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 40; ++i) {
    const double lower = normal(random);
    const double upper = i % 4 == 0 ? kInfinity : lower + 0.3 + std::abs(2.0 * normal(random));
    const TruncatedNormal of{lower + 3.0 * normal(random), 0.2 + std::abs(normal(random)), lower, upper};
    INFO(of.mean << " +- " << of.sd << " between " << of.lower << " and " << of.upper);
    const TruncatedSpread spread = find_spread(of);
    const Grid grid(of);
    const double all = grid.sum(-kInfinity, kInfinity);
    CHECK(grid.sum(spread.low_95, spread.high_95) / all == Approx(0.95).margin(2e-4));
    CHECK(spread.sd == Approx(grid.find_sd()).epsilon(1e-3));
    CHECK(spread.low_95 >= of.lower);
    CHECK(spread.high_95 <= of.upper);
    const double likeliest = std::fmin(std::fmax(of.mean, of.lower), of.upper);
    CHECK(spread.low_95 <= likeliest);
    CHECK(spread.high_95 >= likeliest);
    const double length = spread.high_95 - spread.low_95;
    for (const double shift : {-0.02 * length, 0.02 * length}) {  // no other interval of the length holds more
      CHECK(grid.sum(spread.low_95 + shift, spread.high_95 + shift) / all < 0.9502);
    }
  }
}

TEST_CASE("a limit far out in the tail of a normal distribution loses no precision", "[fast]") {
  CHECK(calc_log_mass({0.0, 1.0, -kInfinity, -30.0}) == Approx(-454.3212).epsilon(1e-5));
  CHECK(calc_log_mass({0.0, 1.0, 30.0, kInfinity}) == Approx(-454.3212).epsilon(1e-5));
  for (const double far : {24.999, 25.001}) {  // on both sides of where the way of calculating changes
    INFO(far);
    const TruncatedSpread spread = find_spread({far, 1.0, -1.0, 0.0});
    CHECK(spread.high_95 == 0.0);
    CHECK(spread.low_95 == Approx(-3.0 / 25.0).epsilon(0.01));
    CHECK(spread.sd == Approx(1.0 / 25.0).epsilon(0.01));
    CHECK(calc_log_mass({far, 1.0, -1.0, 0.0}) == Approx(-0.5 * far * far - 4.1393).epsilon(1e-4));
  }
}
