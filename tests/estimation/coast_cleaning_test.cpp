// The coast is found, wrong pulses go.
#include <catch2/catch.hpp>

#include "estimation/drum_deceleration/coast_cleaning.h"
#include "sim/core/error.h"

using namespace rollrig;
using estimation::CoastRun;
using estimation::CoastSeries;
using estimation::find_coast;

namespace {

/// Spin-up to 20 m/s in 40 s, 60 s of drive, then 0.1 m/s2 down to 5 m/s, a row each 0.25 s.
CoastSeries make_record() {
  CoastSeries series;
  for (double t = 0.0; t < 250.0; t += 0.25) {
    series.time_s.push_back(t);
    series.speed_m_s.push_back(t < 40.0 ? 0.5 * t + 0.01 : t < 100.0 ? 20.0 : 20.0 - 0.1 * (t - 100.0));
  }
  return series;
}

}  // namespace

TEST_CASE("the coast starts when the speed leaves the top for good", "[fast]") {
  CoastSeries series = make_record();
  const auto coast = find_coast(series, std::nullopt, {});
  CHECK(coast.start_s == Approx(104.0).margin(0.5));  // 2 % below the top
  CHECK(coast.missed + coast.doubled + coast.other == 0);
  CHECK(coast.rise_m_s == 0.0);
  for (std::size_t i = 80; i < 90; ++i) series.speed_m_s[i] = 12.0;  // a pause while it is driven changes nothing
  CHECK(find_coast(series, std::nullopt, {}).start_s == coast.start_s);
}

TEST_CASE("missed and double pulses are told apart and left out", "[fast]") {
  CoastSeries series = make_record();
  for (const std::size_t i : {500U, 600U, 601U}) series.speed_m_s[i] *= 0.5;
  series.speed_m_s[700] *= 2.0;
  series.speed_m_s[800] /= 3.0;
  series.speed_m_s[820] *= 5.0;
  const auto coast = find_coast(series, std::nullopt, {});
  CHECK(coast.missed == 4);
  CHECK(coast.doubled == 1);
  CHECK(coast.other == 1);
  for (std::size_t i = 1; i < coast.speed_m_s.size(); ++i) CHECK(coast.speed_m_s[i] <= coast.speed_m_s[i - 1]);
}

TEST_CASE("a double pulse while it is driven is not taken for the top", "[fast]") {
  CoastSeries series = make_record();
  const double start_s = find_coast(series, std::nullopt, {}).start_s;
  series.speed_m_s[200] *= 2.0;
  series.speed_m_s[900] *= 2.0;
  CHECK(find_coast(series, std::nullopt, {}).start_s == start_s);
}

TEST_CASE("a speed that repeats to the end is of a body at rest", "[fast]") {
  CoastSeries series = make_record();
  const std::size_t rows = find_coast(series, std::nullopt, {}).time_s.size();
  for (int i = 0; i < 40; ++i) {
    series.time_s.push_back(250.0 + i);
    series.speed_m_s.push_back(5.5);
  }
  const auto coast = find_coast(series, std::nullopt, {});
  CHECK(coast.stopped == 40);
  CHECK(coast.time_s.size() == rows);
}

TEST_CASE("a second drive within the coast is seen", "[fast]") {
  CoastSeries series = make_record();
  for (std::size_t i = 700; i < series.time_s.size(); ++i) series.speed_m_s[i] += 2.0;
  CHECK(find_coast(series, std::nullopt, {}).rise_m_s == Approx(1.9).margin(0.2));
}

TEST_CASE("a speed from a period holds half a period before its row", "[fast]") {
  const auto plain = find_coast(make_record(), std::nullopt, {});
  const auto shifted = find_coast(make_record(), 4.8, {});
  REQUIRE(plain.time_s.size() == shifted.time_s.size());
  CHECK(plain.time_s[5] - shifted.time_s[5] == Approx(2.4 / plain.speed_m_s[5]));
}

TEST_CASE("a record that ends with the drive has no coast", "[fast]") {
  CoastSeries series = make_record();
  series.time_s.resize(380);
  series.speed_m_s.resize(380);
  CHECK_THROWS_AS(find_coast(series, std::nullopt, {}), InputError);
}
