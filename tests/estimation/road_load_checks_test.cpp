#include "estimation/road_load/road_load_checks.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/coastdown_study.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using estimation::check_road_load;
using estimation::CheckStatus;
using estimation::CoastdownData;
using estimation::RoadLoadCheck;
using estimation::RoadLoadChecks;

namespace {

RoadLoadChecks check_study(const CoastdownData& data) {
  estimation::RoadLoadFitOptions options;
  options.mass_kg = 2100.0;
  return check_road_load(data, estimation::fit_road_load(data, options));
}

const RoadLoadCheck& find(const RoadLoadChecks& checks, const std::string& name) {
  for (const RoadLoadCheck& check : checks.checks) {
    if (check.name == name) return check;
  }
  FAIL("no check " << name);
  return checks.checks.front();
}

void set_conditions(CoastdownData& data, double ambient_K, double wind, double crosswind, double slope) {
  for (auto& run : data.runs) {
    const std::size_t n = run.time_s.size();
    run.conditions.ambient_K.assign(n, ambient_K);
    run.conditions.wind_m_s.assign(n, wind);
    run.conditions.crosswind_m_s.assign(n, crosswind);
    run.conditions.slope.assign(n, slope);
  }
}

}  // namespace

TEST_CASE("a calm session on a level road passes every check", "[fast]") {
  CoastdownData data = tests::simulate_coastdowns({}, 1);
  set_conditions(data, 293.15, 0.0, 0.0, 0.0);
  const RoadLoadChecks checks = check_study(data);
  for (const RoadLoadCheck& check : checks.checks) {
    INFO(check.name << " " << check.found);
    CHECK(check.status == CheckStatus::kPass);
    CHECK_FALSE(check.clause.empty());
  }
  CHECK(checks.precisions.size() >= 10);
}

TEST_CASE("what the file does not say is not checked, and no check is dropped", "[fast]") {
  const RoadLoadChecks bare = check_study(tests::simulate_coastdowns({}, 1));
  for (const char* name : {"wind, mean", "wind, peak", "crosswind, mean", "slope", "ambient temperature"}) {
    CHECK(find(bare, name).status == CheckStatus::kNotChecked);
    CHECK_THAT(find(bare, name).found, Catch::StartsWith("no column"));
  }
}

TEST_CASE("wind, slope, cold and too few runs fail their own check", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 2;
  study.from_km_h = 100.0;
  CoastdownData data = tests::simulate_coastdowns(study, 1);
  set_conditions(data, 275.0, 5.0, 3.0, 0.01);
  const RoadLoadChecks checks = check_study(data);
  for (const char* name : {"wind, mean", "wind, peak", "crosswind, mean", "slope", "ambient temperature",
                           "runs each way", "speed range"}) {
    INFO(name);
    CHECK(find(checks, name).status == CheckStatus::kFail);
  }
  CHECK_THAT(find(checks, "speed range").found, Catch::StartsWith("100") && Catch::Contains(" to 15"));
  CHECK(find(checks, "slope, constant").status == CheckStatus::kPass);
}

TEST_CASE("precision of two pairs by hand", "[fast]") {
  // pair times 10 s (10 and 10) and 12 s (12 and 12): mean 11, s = sqrt(2), t of one degree 12.706:
  // 12.706 * 1.41421 / (1.41421 * 11) = 1.15509; the second pair's harmonic mean of 15 and 10 is 12
  CoastdownData data;
  estimation::RoadLoadFit fit;
  const double high = 85.0 / 3.6, low = 75.0 / 3.6;
  const double times[4] = {10.0, 10.0, 15.0, 10.0};
  for (std::size_t i = 0; i < 4; ++i) {
    data.runs.emplace_back();
    data.runs.back().heading = i % 2 == 0 ? +1 : -1;
    estimation::RoadLoadPoint point;
    point.run = i;
    point.high_m_s = high;
    point.low_m_s = low;
    point.duration_s = times[i];
    fit.points.push_back(point);
  }
  const auto precisions = estimation::find_pair_precisions(data, fit);
  REQUIRE(precisions.size() == 1);
  CHECK(precisions[0].speed_m_s == Approx(80.0 / 3.6));
  CHECK(precisions[0].pairs == 2);
  CHECK(precisions[0].mean_time_s == Approx(11.0));
  CHECK(precisions[0].precision == Approx(1.15509).epsilon(1e-4));
}

TEST_CASE("runs that differ fail the repeatability of pairs", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 30.0;
  CHECK(find(check_study(tests::simulate_coastdowns(study, 1)), "repeatability of pairs").status == CheckStatus::kFail);
}

TEST_CASE("a drift of the rolling loss is found, with intervals that hold it at their rate", "[fast]") {
  // A and B fall by 6 % over the session; without B and C the times would rise by 6 %
  tests::CoastdownStudy study;
  study.load = {200.0, 0.0, 0.0};
  study.from_km_h = 80.0;
  study.drift = -0.06;
  study.run_force_sd_N = 1.0;
  int covered = 0;
  double sum = 0.0, squares = 0.0, reach = 0.0;
  constexpr int kSeeds = 60;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const CoastdownData data = tests::simulate_coastdowns(study, seed);
    const RoadLoadChecks checks = check_study(data);
    REQUIRE(checks.drifts.size() == 1);
    sum += checks.drifts[0].time_change;
    squares += checks.drifts[0].time_change * checks.drifts[0].time_change;
    reach += 0.5 * (checks.drifts[0].upper_95 - checks.drifts[0].lower_95) / kSeeds;
    CHECK(checks.drifts[0].runs == 10);
    CHECK(checks.drifts[0].time_change == Approx(0.06).margin(0.03));
    CHECK(checks.drifts[0].per_run == Approx(checks.drifts[0].time_change / 9.0));
    // relative to the mean force, -3 % below the first: 0.06/0.97
    const double truth = 0.06 / 0.97;
    covered += checks.drifts[0].lower_95 <= truth && truth <= checks.drifts[0].upper_95 ? 1 : 0;
  }
  INFO(covered);
  CHECK_FALSE(tests::is_rejected(covered, kSeeds, 0.95, 0.01));
  // no wider than that takes: t of 6 degrees (10 runs, 4 coefficients) times what the seeds scatter by
  CHECK(reach == Approx(2.447 * std::sqrt((squares - sum * sum / kSeeds) / (kSeeds - 1))).epsilon(0.3));
}

TEST_CASE("a wind that turns is no drift", "[fast]") {
  // the wind rises from one end of the session to the other: headings part, their mean stays
  tests::CoastdownStudy study;
  CoastdownData data;
  for (int i = 0; i < 10; ++i) {
    study.wind_m_s = 0.1 * i;
    study.pairs = 1;
    const CoastdownData pair = tests::simulate_coastdowns(study, 7);
    data.runs.push_back(pair.runs[i % 2 == 0 ? 0 : 1]);
    data.runs.back().id = std::to_string(i);
    data.runs.back().start_s = 300.0 * i;
  }
  const RoadLoadChecks checks = check_study(data);
  REQUIRE(checks.drifts.size() == 1);
  CHECK(std::abs(checks.drifts[0].time_change) < 0.005);
}

TEST_CASE("air that is hotter than any test allows is doubted for its unit", "[fast]") {
  CoastdownData data = tests::simulate_coastdowns({}, 1);
  set_conditions(data, 273.15 + 34.0, 0.0, 0.0, 0.0);
  CHECK_FALSE(estimation::doubt_ambient(data).has_value());
  set_conditions(data, 273.15 + 48.2, 0.0, 0.0, 0.0);
  CHECK_THAT(*estimation::doubt_ambient(data), Catch::Contains("Fahrenheit (9.0 degC then)"));
}
