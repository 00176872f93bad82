// What a person is told of coastdowns that are not what they seem, and what the result then rests on.
#include "estimation/road_load/checked_road_load.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/error.h"
#include "tests/support/coastdown_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

RoadLoadFitOptions make_options() {
  RoadLoadFitOptions options;
  options.mass_kg = 2100.0;
  options.rotating_mass_kg = 63.0;
  return options;
}

CoastdownFile make_file(const tests::CoastdownStudy& study = {}) {
  CoastdownFile file;
  file.data = tests::simulate_coastdowns(study, 1);
  file.is_trace = true;
  return file;
}

}  // namespace

TEST_CASE("a file with every run twice has the result and the intervals of the runs alone", "[fast]") {
  tests::CoastdownStudy study;
  study.run_force_sd_N = 3.0;
  CoastdownFile once = make_file(study);
  CoastdownFile twice = once;
  for (CoastdownRun copy : once.data.runs) {
    copy.id += " again";
    copy.session = "other";
    twice.data.runs.push_back(copy);
  }
  const RoadLoadFit single = fit_checked_road_load(once, make_options());
  const RoadLoadFit both = fit_checked_road_load(twice, make_options());
  CHECK(single.doubts.empty());
  CHECK(both.doubts.size() == 10);
  CHECK(twice.data.runs.size() == 10);
  for (int i = 0; i < 3; ++i) {
    CHECK(both.values()[static_cast<std::size_t>(i)] == single.values()[static_cast<std::size_t>(i)]);
    CHECK(both.interval_95(i) == single.interval_95(i));
  }
}

TEST_CASE("of a braked run the others tell the truth, beside the result of all", "[fast]") {
  CoastdownFile file = make_file();
  CoastdownRun& run = file.data.runs[4];
  const std::string id = run.id;
  for (double& time_s : run.time_s) time_s *= 0.7;
  const RoadLoadFit fit = fit_checked_road_load(file, make_options());
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].runs == std::vector<std::string>{id});
  CHECK(fit.doubts[0].relative == Approx(1.0 / 0.7 - 1.0).epsilon(0.05));
  CHECK_THAT(fit.warnings.front(), Contains("run '5' has 43 % more force"));
  REQUIRE(fit.others != nullptr);
  CHECK(fit.others->load.A_N == Approx(120.0).epsilon(0.02));
  CHECK(std::abs(fit.others->load.A_N - 120.0) < std::abs(fit.load.A_N - 120.0));
  CHECK(fit.others->interval_95(0)[1] - fit.others->interval_95(0)[0] < fit.interval_95(0)[1] - fit.interval_95(0)[0]);
}

TEST_CASE("A or C below zero is warned of", "[fast]") {
  tests::CoastdownStudy study;
  study.load = {60.0, 22.0, -0.15};
  study.from_km_h = 90.0;
  CoastdownFile file = make_file(study);
  const RoadLoadFit fit = fit_checked_road_load(file, make_options());
  CHECK(fit.load.C_N_s2_per_m2 < 0.0);
  std::string all;
  for (const std::string& warning : fit.warnings) all += warning;
  CHECK_THAT(all, Contains("C is below 0"));
}

TEST_CASE("an interval does not go beyond the limits, and what stands on one is marked", "[fast]") {
  tests::CoastdownStudy study;
  study.run_force_sd_N = 5.0;
  study.run_wind_sd_m_s = 0.3;
  CoastdownFile file = make_file(study);
  const RoadLoadFit free = fit_checked_road_load(file, make_options());
  RoadLoadFitOptions options = make_options();
  const double none = RoadLoadBounds::kNone;
  // within the interval, below the estimate: the interval is cut, the estimate stays
  const double below = 0.5 * (free.load.B_N_s_per_m + free.interval_95(1)[0]);
  options.bounds = RoadLoadBounds{{-none, below, -none}, {none, none, none}};
  const RoadLoadFit cut = fit_road_load(file.data, options);
  CHECK_FALSE(cut.on_bound[1]);
  CHECK(cut.is_cut(1));
  CHECK_FALSE(cut.is_cut(0));
  CHECK(cut.interval_95(1)[0] == below);
  CHECK(cut.interval_95(1)[1] == Approx(free.interval_95(1)[1]));
  // above the estimate: it stands on the limit, and its interval reaches from there to where the free one ends
  const double above = 0.5 * (free.load.B_N_s_per_m + free.interval_95(1)[1]);
  options.bounds = RoadLoadBounds{{-none, above, -none}, {none, none, none}};
  const RoadLoadFit on_limit = fit_road_load(file.data, options);
  CHECK(on_limit.on_bound[1]);
  CHECK(on_limit.is_cut(1));
  CHECK(on_limit.interval_95(1)[0] == above);
  CHECK(on_limit.interval_95(1)[1] > above);
}

TEST_CASE("runs that have no fit together are named, and the others have their result", "[fast]") {
  CoastdownFile file = make_file();
  CoastdownRun& run = file.data.runs[2];
  const std::string id = run.id;
  // driven below 60 km/h: the speed falls by hardly anything there
  for (std::size_t i = 1; i < run.time_s.size(); ++i) {
    if (run.speed_m_s[i] < 60.0 / 3.6) run.time_s[i] = run.time_s[i - 1] + 5.0;
  }
  const RoadLoadFit fit = fit_checked_road_load(file, make_options());
  REQUIRE_FALSE(fit.doubts.empty());
  CHECK(fit.doubts[0].runs == std::vector<std::string>{id});
  CHECK(fit.doubts[0].likely == "driven");
  const double A_N = fit.others != nullptr ? fit.others->load.A_N : fit.load.A_N;
  CHECK(A_N == Approx(120.0).epsilon(0.02));
}

TEST_CASE("on a slope, where the force downhill is small, no run is odd that scatters as the others", "[slow]") {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    tests::CoastdownStudy study;
    study.load.A_N = 100.0;
    study.slope = 0.0035;
    study.run_force_sd_N = 3.0;
    study.run_wind_sd_m_s = 0.2;
    CoastdownData data = tests::simulate_coastdowns(study, seed);
    alarms += check_coastdowns(data, make_options()).doubts.empty() ? 0 : 1;
  }
  CHECK(alarms <= 4);  // one of 200 is meant; five or more of 150 are one in a thousand
}
