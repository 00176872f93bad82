#include "estimation/run_checks/recording_repeats.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

/// A coast with noise, written to millimeters a second.
RecordedSeries make_series(std::uint64_t seed, double level = 1.0, double noise_m_s = 0.01) {
  RandomStream random(seed, "series");
  RecordedSeries series;
  double speed_m_s = 25.0;
  for (double time_s = 0.0; speed_m_s > 3.0; time_s += 0.2) {
    series.time_s.push_back(time_s);
    series.speed_m_s.push_back(std::round(1e3 * (speed_m_s + noise_m_s * random.normal())) / 1e3);
    speed_m_s -= 0.2 * level * (0.1 + 3e-4 * speed_m_s * speed_m_s);
  }
  return series;
}

}  // namespace

TEST_CASE("the step in which numbers were written is found, also in km/h", "[fast]") {
  CHECK(find_resolution({1.25, 3.5, 7.75, 0.05}, {1.0}) == Approx(0.05));
  CHECK(find_resolution({12.3, 45.6, 78.9}, {1.0}) == Approx(0.1));
  CHECK(find_resolution({36.1 / 3.6, 52.4 / 3.6, 99.9 / 3.6}, {1.0, 1.0 / 3.6}) == Approx(0.1 / 3.6));
}

TEST_CASE("a copy is found: as it is, on another clock, rounded, in km/h, every second row", "[fast]") {
  const RecordedSeries series = make_series(1);
  RecordedSeries copy = series;
  SECTION("as it is") {}
  SECTION("on another clock") {
    for (double& time : copy.time_s) time += 1234.5;
  }
  SECTION("rounded") {
    for (double& speed : copy.speed_m_s) speed = std::round(100.0 * speed) / 100.0;
  }
  SECTION("in km/h") {
    for (double& speed : copy.speed_m_s) speed = std::round(360.0 * speed) / 360.0;
  }
  SECTION("every second row") {
    copy = {};
    for (std::size_t i = 0; i < series.time_s.size(); i += 2) {
      copy.time_s.push_back(series.time_s[i]);
      copy.speed_m_s.push_back(series.speed_m_s[i]);
    }
  }
  const auto repeats = find_series_repeats({make_series(2), series, make_series(3), copy});
  REQUIRE(repeats.size() == 1);
  CHECK(repeats[0].first == 1);
  CHECK(repeats[0].second == 3);
  CHECK(10 * (repeats[0].end - repeats[0].begin) > 9 * copy.time_s.size());
}

TEST_CASE("of a recording that is in part another one, the part is found", "[fast]") {
  const RecordedSeries series = make_series(1);
  RecordedSeries joined = make_series(2);
  const std::size_t shared = joined.time_s.size() / 3;
  for (std::size_t i = 0; i < shared; ++i) joined.speed_m_s[i] = series.speed_m_s[i];
  const auto repeats = find_series_repeats({series, joined});
  REQUIRE(repeats.size() == 1);
  CHECK(repeats[0].begin == 0);
  CHECK(repeats[0].end >= shared);
  CHECK(repeats[0].end < shared + 5);
}

TEST_CASE("coasts that repeat each other are no copies, with noise or nearly without", "[fast]") {
  for (const double noise_m_s : {0.01, 1e-4}) {
    std::vector<RecordedSeries> series;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      series.push_back(make_series(seed, 1.0 + 2e-3 * static_cast<double>(seed), noise_m_s));
    }
    CHECK(find_series_repeats(series).empty());
  }
}
