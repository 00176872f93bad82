// Sessions whose speeds are in another unit than the column says.
#include "estimation/road_load/session_units.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "sim/core/units.h"
#include "tests/support/session_study.h"

using namespace rollrig;
using estimation::CoastdownData;
using estimation::CoastdownRun;
using tests::CoastdownStudy;
using tests::fit_checked;
using tests::has_warning;
using tests::join_sessions;
using tests::with_speeds_over;

namespace {

constexpr double kMph = kMph_m_s * kKmhPerMs;
constexpr double kMetersPerSecond = kKmhPerMs;

CoastdownData simulate_like_sessions(const std::vector<std::string>& names, const CoastdownStudy& study) {
  std::vector<std::pair<std::string, CoastdownStudy>> studies;
  for (const std::string& name : names) studies.emplace_back(name, study);
  return tests::simulate_sessions(studies);
}

}  // namespace

TEST_CASE("a session in mph is named with its unit by the default method, j1263 and wltp, and none of its runs is odd",
          "[slow]") {
  const CoastdownStudy study = tests::make_whole_runs();
  const CoastdownData data = with_speeds_over(join_sessions(study, study), "pm", kMph);
  for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
    INFO(method);
    CHECK(has_warning(warnings, "the forces of session 'pm' over speed"));
    CHECK(has_warning(warnings, "if its values of speed_km_h are in mph"));
  }
  CHECK(fit_checked(data).doubts.empty());
}

TEST_CASE("two of four sessions in mph are named by the default method, j1263 and wltp", "[slow]") {
  CoastdownData data = simulate_like_sessions({"a", "b", "c", "d"}, tests::make_whole_runs());
  data = with_speeds_over(with_speeds_over(data, "b", kMph), "d", kMph);
  for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
    INFO(method);
    CHECK(has_warning(warnings, "the forces of sessions 'b', 'd' over speed"));
    CHECK(has_warning(warnings, "if their values of speed_km_h are in mph"));
  }
}

TEST_CASE("one session of three in m/s is named by the default method, j1263 and wltp", "[slow]") {
  const CoastdownData data =
      with_speeds_over(simulate_like_sessions({"a", "b", "c"}, tests::make_whole_runs()), "b", kMetersPerSecond);
  for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
    INFO(method);
    CHECK(has_warning(warnings, "the forces of session 'b' over speed"));
    CHECK(has_warning(warnings, "are in m/s: are they?"));
  }
}

TEST_CASE("bins of a session in mph, which no reference speed has, are not dropped in silence by wltp", "[fast]") {
  CoastdownData data = tests::cut_into_bins(simulate_like_sessions({"a", "b", "c"}, tests::make_whole_runs()), 5.0);
  for (CoastdownRun& run : data.runs) {
    if (run.session != "b") continue;
    for (auto& bin : run.bins) {
      bin.high_m_s /= kMph;
      bin.low_m_s /= kMph;
    }
  }
  const auto procedure = tests::fit_reference_speeds(data);
  CHECK(has_warning(procedure, "not used, without a time from v + 5 to v - 5 km/h"));
  CHECK(has_warning(procedure, "if its values of v_hi_kmh and v_lo_kmh are in mph"));
}

TEST_CASE("sessions in m/s are told from the one in km/h, although they are more", "[slow]") {
  CoastdownData data = simulate_like_sessions({"am", "night", "pm"}, tests::make_whole_runs());
  data = with_speeds_over(with_speeds_over(data, "pm", kMetersPerSecond), "night", kMetersPerSecond);
  const auto fit = fit_checked(data);
  CHECK(has_warning(fit, "the forces of sessions 'night', 'pm' over speed"));
  CHECK(has_warning(fit, "are in m/s: are they?"));
}

TEST_CASE("a session in mph and one in m/s are each told from those in km/h", "[slow]") {
  CoastdownData data = simulate_like_sessions({"a", "b", "c", "d"}, tests::make_whole_runs());
  data = with_speeds_over(with_speeds_over(data, "b", kMph), "d", kMetersPerSecond);
  const auto fit = fit_checked(data);
  CHECK(has_warning(fit, "if its values of speed_km_h are in mph"));
  CHECK(has_warning(fit, "if its values of speed_km_h are in m/s"));
}

TEST_CASE("the parts of a split test are not asked for their unit", "[slow]") {
  // The lower part in mph would have the speeds of the upper one, and nearly its forces.
  for (const auto& load : {models::RoadLoad<double>{116.0, 3.0, 0.3}, models::RoadLoad<double>{150.0, 5.0, 0.4},
                           models::RoadLoad<double>{120.0, 3.0, 0.35}}) {
    CoastdownStudy upper = tests::make_whole_runs();
    upper.load = load;
    CoastdownStudy lower = upper;
    upper.to_km_h = 65.0;
    for (const double from_km_h : {70.0, 84.0}) {
      lower.from_km_h = from_km_h;
      INFO(load.A_N << " " << from_km_h);
      CHECK_FALSE(has_warning(fit_checked(join_sessions(upper, lower)), "are they?"));
    }
  }
}

TEST_CASE("a session with another shape of its road load has no odd run, and no other unit", "[slow]") {
  for (const double shape : {0.62, 0.9, 1.4}) {
    CoastdownStudy study;
    study.run_force_sd_N = 3.0;
    CoastdownStudy other = study;
    other.load.A_N *= shape;
    other.load.C_N_s2_per_m2 /= std::sqrt(shape);
    INFO(shape);
    const auto fit = fit_checked(join_sessions(study, other));
    CHECK(fit.doubts.empty());
    CHECK_FALSE(has_warning(fit, "are they?"));
  }
}

TEST_CASE("a session of runs in one heading is named with its unit, too", "[fast]") {
  CoastdownStudy study;
  study.pairs = 4;
  CoastdownData data = join_sessions(study, study);
  std::vector<CoastdownRun> one_way;
  for (const CoastdownRun& run : data.runs) {
    if (run.heading > 0) one_way.push_back(run);
  }
  data.runs = one_way;
  CHECK(has_warning(fit_checked(with_speeds_over(data, "pm", kMph)), "are in mph"));
}
