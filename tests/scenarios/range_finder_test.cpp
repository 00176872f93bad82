#include "scenarios/common/range_finder.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig;
using scenarios::find_last_window;
using scenarios::find_load_ranges;
using scenarios::LoadRange;

namespace {
struct Signal {
  std::vector<double> time_s, load_N, speed_m_s;
  void add(int seconds, double load, double speed) {
    for (int i = 0; i < seconds; ++i) {
      time_s.push_back(static_cast<double>(time_s.size()));
      load_N.push_back(load);
      speed_m_s.push_back(speed);
    }
  }
  std::vector<LoadRange> find() const { return find_load_ranges(time_s, load_N, speed_m_s, 300.0, 20.0); }
};
}  // namespace

TEST_CASE("loads and skims are found from the load signal", "[fast]") {
  Signal signal;
  signal.add(600, 5400.0, 22.0);
  signal.add(180, 200.0, 22.0);
  signal.add(300, 6865.0, 22.0);
  signal.add(180, 200.0, 22.0);
  const auto ranges = signal.find();
  REQUIRE(ranges.size() == 4);
  CHECK(ranges[0].loaded);
  CHECK(ranges[0].start_s == 0.0);
  CHECK(ranges[0].end_s == 600.0);
  CHECK_FALSE(ranges[1].loaded);
  CHECK(ranges[2].load_N == 6865.0);
  CHECK(ranges[2].start_s == 780.0);
}

TEST_CASE("a short spike of load is left out, a ripple of half a percent is none", "[fast]") {
  Signal signal;
  signal.add(100, 5400.0, 22.0);
  signal.add(5, 2000.0, 22.0);
  signal.add(100, 5400.0, 22.0);
  for (std::size_t i = 0; i < signal.load_N.size(); i += 2) signal.load_N[i] *= 1.005;
  const auto ranges = signal.find();
  REQUIRE(ranges.size() == 2);
  CHECK(ranges[1].start_s == 105.0);
}

TEST_CASE("a skim ends where the drum slows", "[fast]") {
  Signal signal;
  signal.add(60, 5400.0, 22.0);
  signal.add(60, 200.0, 22.0);
  for (int i = 1; i <= 30; ++i) signal.add(1, 200.0, 22.0 - 0.7 * i);
  signal.add(60, 200.0, 0.0);
  const auto ranges = signal.find();
  REQUIRE(ranges.size() == 3);
  CHECK(ranges[1].end_s == Approx(120.0));
}

TEST_CASE("the last minute keeps its distance from the change of load", "[fast]") {
  const LoadRange range{true, 5400.0, 0.0, 1800.0};
  CHECK(find_last_window(range, 60.0, 2.0).start_s == 1738.0);
  CHECK(find_last_window(range, 60.0, 2.0).end_s == 1798.0);
  const LoadRange brief{true, 5400.0, 0.0, 30.0};
  CHECK(find_last_window(brief, 60.0, 2.0).start_s == 2.0);
}

TEST_CASE("a window's mean takes samples whose interval lies inside, and no empty one", "[fast]") {
  const std::vector<double> time_s{0, 1, 2, 3, 4, 5};
  const std::vector<double> values{100, 1, std::nan(""), 3, 100, 100};
  CHECK(scenarios::calc_window_mean(time_s, values, {0.5, 3.5}, 1.0) == 2.0);
  CHECK(scenarios::count_window_samples(time_s, values, {0.5, 3.5}, 1.0) == 2);
  CHECK_THROWS_AS(scenarios::calc_window_mean(time_s, values, {1.6, 2.4}, 1.0), RunFailure);
}
