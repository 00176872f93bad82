// Sessions whose headings are exchanged.
#include "estimation/road_load/session_headings.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/support/session_study.h"

using namespace rollrig;
using estimation::CoastdownData;
using estimation::CoastdownRun;
using tests::CoastdownStudy;
using tests::has_warning;
using tests::simulate_sessions;

namespace {

CoastdownStudy make_sloped_study(double slope, double wind_m_s) {
  CoastdownStudy study;
  study.pairs = 4;
  study.run_force_sd_N = 3.0;
  study.run_wind_sd_m_s = 0.2;
  study.from_km_h = 138.0;
  study.to_km_h = 12.0;
  study.slope = slope;
  study.wind_m_s = wind_m_s;
  return study;
}

CoastdownData exchange_headings(CoastdownData data, const std::string& session) {
  for (CoastdownRun& run : data.runs) {
    if (run.session == session) run.heading = -run.heading;
  }
  return data;
}

const std::string kQuestion = "exchanged?";

}  // namespace

TEST_CASE("exchanged headings of one session of three are named by every method, and no run is odd", "[fast]") {
  const CoastdownData data = exchange_headings(simulate_sessions({{"am", make_sloped_study(0.003, 1.0)},
                                                                  {"noon", make_sloped_study(0.003, -0.5)},
                                                                  {"night", make_sloped_study(0.003, 0.5)}}),
                                               "night");
  for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
    INFO(method);
    CHECK(has_warning(warnings, "in sessions 'am', 'noon' and of -0.00"));
    CHECK(has_warning(warnings, "are the headings of session 'night' exchanged?"));
  }
  CHECK(tests::fit_checked(data).doubts.empty());
}

TEST_CASE("exchanged headings of one of two sessions: either may be it", "[fast]") {
  const CoastdownData data =
      exchange_headings(tests::join_sessions(make_sloped_study(-0.004, 0.0), make_sloped_study(-0.004, 0.0)), "pm");
  CHECK(has_warning(tests::fit_checked(data), "are the headings of one or the other exchanged?"));
}

TEST_CASE("winds that turn between sessions are no exchanged headings", "[fast]") {
  for (const double slope : {0.0, 0.003}) {
    INFO(slope);
    const CoastdownData data =
        simulate_sessions({{"am", make_sloped_study(slope, 3.0)}, {"noon", make_sloped_study(slope, -3.0)}});
    for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
      INFO(method);
      CHECK_FALSE(has_warning(warnings, kQuestion));
    }
  }
}

TEST_CASE("sessions on two roads that slope differently are not asked for their headings", "[fast]") {
  const CoastdownData data = tests::join_sessions(make_sloped_study(0.006, 0.0), make_sloped_study(-0.002, 0.0));
  CHECK_FALSE(has_warning(tests::fit_checked(data), kQuestion));
}

TEST_CASE("like sessions are hardly ever asked for their headings", "[slow]") {
  int asked = 0;
  for (std::uint64_t set = 0; set < 60; ++set) {
    const CoastdownData data =
        simulate_sessions({{"am", make_sloped_study(0.0005, 2.0)}, {"pm", make_sloped_study(0.0005, -1.0)}}, 2 * set);
    asked += has_warning(tests::fit_checked(data), kQuestion) ? 1 : 0;
  }
  CHECK(asked == 0);
}
