#include "measurements/spikes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "sim/core/random.h"

using namespace rollrig;
using measurements::find_spikes;

namespace {

const std::vector<bool>& all_judged() {
  static const std::vector<bool> all(20000, true);
  return all;
}

/// A tire that warms up, with drift and noise of 1.
std::vector<double> make_clean(std::uint64_t seed, std::size_t count, double resolution = 0.0) {
  RandomStream random(seed, "clean");
  std::vector<double> values;
  double drift = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    drift = 0.98 * drift + 0.1 * random.normal();
    const double value = 300.0 * (1.0 - std::exp(-static_cast<double>(i) / 2000.0)) + drift + random.normal();
    values.push_back(resolution > 0.0 ? resolution * std::round(value / resolution) : value);
  }
  return values;
}

}  // namespace

TEST_CASE("a clean record has less than one spike in 100 000 rows", "[fast]") {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    found += find_spikes(make_clean(seed, 20000), 7.0, 0.0, all_judged()).size();
  }
  CHECK(found <= 3);  // of 300 000
}

TEST_CASE("steps, ramps and rounding are no spikes", "[fast]") {
  std::vector<double> steps = make_clean(3, 6000, 0.5);
  for (std::size_t i = 2000; i < 4000; ++i) steps[i] += 500.0;
  CHECK(find_spikes(steps, 7.0, 0.5, all_judged()).empty());
  std::vector<double> coarse = make_clean(4, 6000, 25.0);  // mostly the same value again and again
  CHECK(find_spikes(coarse, 7.0, 25.0, all_judged()).empty());
  std::vector<double> triangle;
  for (int i = 0; i < 6000; ++i) triangle.push_back(std::abs(i % 20 - 10));
  CHECK(find_spikes(triangle, 7.0, 0.0, all_judged()).empty());
}

TEST_CASE("spikes of one row and of two are found, each row of them and no other", "[fast]") {
  std::size_t planted_in_all = 0, found_in_all = 0, others = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<double> values = make_clean(seed, 5000);
    RandomStream random(seed, "spikes");
    std::vector<std::size_t> planted;
    for (std::size_t at = 50; at + 50 < values.size(); at += 200) {
      const std::size_t row = at + static_cast<std::size_t>(100.0 * random.uniform());
      const double size = (random.uniform() < 0.5 ? -1.0 : 1.0) * (20.0 + 500.0 * random.uniform());
      const std::size_t length = random.uniform() < 0.5 ? 1 : 2;
      for (std::size_t k = 0; k < length; ++k) {
        values[row + k] += size;
        planted.push_back(row + k);
      }
    }
    const std::vector<std::size_t> found = find_spikes(values, 7.0, 0.0, all_judged());
    for (const std::size_t row : found) {
      const bool is_planted = std::find(planted.begin(), planted.end(), row) != planted.end();
      found_in_all += is_planted ? 1 : 0;
      others += is_planted ? 0 : 1;
    }
    planted_in_all += planted.size();
  }
  CHECK(planted_in_all > 500);
  CHECK(found_in_all == planted_in_all);
  CHECK(others == 0);
}

TEST_CASE("rows that are not judged keep their values, missing ones are passed over", "[fast]") {
  std::vector<double> values = make_clean(9, 1000);
  values[500] += 100.0;
  values[499] = std::nan("");
  std::vector<bool> judged(1000, true);
  CHECK(find_spikes(values, 7.0, 0.0, judged) == std::vector<std::size_t>{500});
  judged[500] = false;
  CHECK(find_spikes(values, 7.0, 0.0, judged).empty());
}
