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

namespace {

/// Of how many sets the fit says that their sessions differ.
struct Doubted {
  int same = 0;
  int apart = 0;  // of the first ten sets, with one session 5 % slower
};

Doubted count_doubted(int sets) {
  Doubted doubted;
  for (int seed = 1; seed <= sets; ++seed) {
    tests::CoastdownStudy study;
    study.pairs = 9;
    study.interval_s = 0.5;
    study.run_force_sd_N = 3.0;
    CoastdownData data = tests::simulate_coastdowns(study, static_cast<std::uint64_t>(seed));
    const auto count = [&data] {
      estimation::RoadLoadFitOptions options;
      options.mass_kg = 2100.0;
      for (const std::string& warning : estimation::fit_road_load(data, options).warnings) {
        if (warning.find("the sessions differ") != std::string::npos) return 1;
      }
      return 0;
    };
    for (std::size_t i = 0; i < data.runs.size(); ++i) data.runs[i].session = std::to_string(i / 6);
    doubted.same += count();
    if (seed > 10) continue;
    for (std::size_t i = 0; i < 6; ++i) {
      for (double& time_s : data.runs[i].time_s) time_s *= 1.05;
    }
    doubted.apart += count();
  }
  return doubted;
}

/// Two sessions of the same kind, one after the other.
CoastdownData join_sessions(const tests::CoastdownStudy& first, const tests::CoastdownStudy& second) {
  CoastdownData data = tests::simulate_coastdowns(first, 1);
  for (auto& run : tests::simulate_coastdowns(second, 2).runs) {
    data.runs.push_back(run);
    data.runs.back().session = "pm";
  }
  return data;
}

estimation::RoadLoadFit fit_study(const CoastdownData& data) {
  estimation::RoadLoadFitOptions options;
  options.mass_kg = tests::CoastdownStudy().mass_kg;
  return estimation::fit_road_load(data, options);
}

bool mentions_sessions(const estimation::RoadLoadFit& fit, const std::string& text) {
  return std::any_of(fit.warnings.begin(), fit.warnings.end(),
                     [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

bool holds_both(const estimation::RoadLoadFit& fit, int coefficient, double low, double high) {
  const auto [lower, upper] = fit.interval_95(coefficient);
  return lower <= low && high <= upper;
}

}  // namespace

TEST_CASE("sessions that differ by a share of the force: it is said, and the intervals hold both", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 1.0;
  tests::CoastdownStudy high = study;
  high.load = {1.2 * study.load.A_N, 1.2 * study.load.B_N_s_per_m, 1.2 * study.load.C_N_s2_per_m2};
  const CoastdownData data = join_sessions(study, high);
  const estimation::RoadLoadFit fit = fit_study(data);
  // 1 and 1.2 times the same: a standard deviation of 0.1414 about a mean of 1.1
  CHECK(fit.scatter.session_share.value_or(0.0) == Approx(0.1414 / 1.1).epsilon(0.1));
  CHECK_FALSE(fit.scatter.session_force_N.has_value());
  CHECK(mentions_sessions(fit, "the sessions differ by a standard deviation of 12."));
  CHECK(holds_both(fit, 0, study.load.A_N, high.load.A_N));
  CHECK(holds_both(fit, 2, study.load.C_N_s2_per_m2, high.load.C_N_s2_per_m2));
}

TEST_CASE("sessions that differ by the same force at all speeds widen A, and not C", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 1.0;
  tests::CoastdownStudy high = study;
  high.load.A_N += 20.0;
  const estimation::RoadLoadFit fit = fit_study(join_sessions(study, high));
  CHECK(fit.scatter.session_force_N.value_or(0.0) == Approx(20.0 / std::sqrt(2.0)).epsilon(0.1));
  CHECK_FALSE(fit.scatter.session_share.has_value());
  CHECK(holds_both(fit, 0, study.load.A_N, high.load.A_N));
  CHECK(fit.sd(2) < 0.005 * fit.load.C_N_s2_per_m2);
}

TEST_CASE("sessions that do not differ are hardly ever doubted, those 5 % apart mostly", "[slow]") {
  const Doubted doubted = count_doubted(25);
  CHECK(doubted.same <= 2);
  CHECK(doubted.apart >= 6);  // of ten: 7
}

TEST_CASE("sessions that do not differ are doubted in one set of a hundred", "[weekly]") {
  CHECK(count_doubted(100).same <= 4);
}

TEST_CASE("air that is hotter than any test allows is doubted for its unit", "[fast]") {
  CoastdownData data = tests::simulate_coastdowns({}, 1);
  set_conditions(data, 273.15 + 34.0, 0.0, 0.0, 0.0);
  CHECK_FALSE(estimation::doubt_ambient(data).has_value());
  set_conditions(data, 273.15 + 48.2, 0.0, 0.0, 0.0);
  CHECK_THAT(*estimation::doubt_ambient(data), Catch::Contains("Fahrenheit (9.0 degC then)"));
}
