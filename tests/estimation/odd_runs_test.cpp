#include "estimation/run_checks/odd_runs.h"

#include <catch2/catch.hpp>

#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

/// Runs whose levels and values scatter by 1 %.
std::vector<RunDeviation> make_runs(std::size_t runs, std::uint64_t seed) {
  RandomStream random(seed, "odd runs");
  std::vector<RunDeviation> deviations;
  for (std::size_t run = 0; run < runs; ++run) {
    RunDeviation deviation;
    deviation.run = run;
    const double level = 0.01 * random.normal();
    for (double speed_m_s = 30.0; speed_m_s > 5.0; speed_m_s -= 2.0) {
      deviation.speed_m_s.push_back(speed_m_s);
      deviation.relative.push_back(level + 0.01 * random.normal());
    }
    deviations.push_back(deviation);
  }
  return deviations;
}

}  // namespace

TEST_CASE("of runs that scatter alike none is odd, save in one set of two hundred", "[fast]") {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) alarms += find_odd_run(make_runs(8, seed)).has_value() ? 1 : 0;
  CHECK(alarms <= 4);
}

TEST_CASE("a run that is off as a whole is named, with its size and sign", "[fast]") {
  for (const double size : {0.3, -0.2}) {
    std::vector<RunDeviation> runs = make_runs(8, 1);
    for (double& value : runs[3].relative) value += size;
    const auto odd = find_odd_run(runs);
    REQUIRE(odd.has_value());
    CHECK(odd->run == 3);
    CHECK(odd->is_whole);
    CHECK(odd->relative == Approx(size).margin(0.03));
    CHECK(odd->sds * size > 0.0);
  }
}

TEST_CASE("a run that is off over a part of its speeds is named with that part", "[fast]") {
  std::vector<RunDeviation> runs = make_runs(8, 2);
  for (std::size_t i = 4; i < 9; ++i) runs[5].relative[i] += 0.3;
  const auto odd = find_odd_run(runs);
  REQUIRE(odd.has_value());
  CHECK(odd->run == 5);
  CHECK_FALSE(odd->is_whole);
  constexpr double kOneValue_m_s = 2.01;  // noise may cost one value at an end
  CHECK(odd->high_m_s == Approx(runs[5].speed_m_s[4]).margin(kOneValue_m_s));
  CHECK(odd->low_m_s == Approx(runs[5].speed_m_s[8]).margin(kOneValue_m_s));
}

TEST_CASE("the scatter of a group decides: what is odd among quiet runs is not among those that scatter", "[fast]") {
  std::vector<RunDeviation> runs = make_runs(12, 3);
  for (double& value : runs[0].relative) value += 0.15;
  CHECK(find_odd_run(runs).has_value());
  RandomStream random(4, "levels");
  for (RunDeviation& run : runs) {
    const double level = 0.1 * random.normal();
    for (double& value : run.relative) value += level;
  }
  CHECK_FALSE(find_odd_run(runs).has_value());
}

TEST_CASE("two runs do not tell which one is odd", "[fast]") {
  std::vector<RunDeviation> runs = make_runs(2, 5);
  for (double& value : runs[0].relative) value += 0.5;
  CHECK_FALSE(find_odd_run(runs).has_value());
}
