// Sessions whose headings are exchanged.
#include "estimation/road_load/session_headings.h"

#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/random.h"
#include "sim/core/units.h"
#include "tests/support/session_study.h"

using namespace rollrig;
using estimation::CoastdownData;
using estimation::CoastdownRun;
using tests::CoastdownStudy;
using tests::has_warning;
using tests::simulate_sessions;

namespace {

CoastdownStudy make_sloped_study(double slope, double wind_m_s) {
  CoastdownStudy study = tests::make_whole_runs();
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

TEST_CASE(
    "exchanged headings of one session of three are named by the default method, j1263 and wltp, and no run is odd",
    "[slow]") {
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

TEST_CASE("exchanged headings of one of two sessions: either may be it", "[slow]") {
  const CoastdownData data =
      exchange_headings(tests::join_sessions(make_sloped_study(-0.004, 0.0), make_sloped_study(-0.004, 0.0)), "pm");
  CHECK(has_warning(tests::fit_checked(data), "are the headings of one or the other exchanged?"));
}

TEST_CASE("winds that turn between sessions are no exchanged headings", "[slow]") {
  for (const double slope : {0.0, 0.003}) {
    INFO(slope);
    const CoastdownData data =
        simulate_sessions({{"am", make_sloped_study(slope, 3.0)}, {"noon", make_sloped_study(slope, -3.0)}});
    for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
      INFO(method);
      CHECK_FALSE(has_warning(warnings, kQuestion));
      CHECK_FALSE(has_warning(warnings, "the sessions differ"));
    }
  }
}

TEST_CASE("exchanged headings are no difference of the sessions' forces", "[slow]") {
  const CoastdownData data = exchange_headings(
      simulate_sessions({{"am", make_sloped_study(0.003, 0.0)}, {"pm", make_sloped_study(0.003, 0.0)}}), "pm");
  for (const auto& [method, warnings] : tests::list_warnings_by_method(data)) {
    INFO(method);
    CHECK(has_warning(warnings, kQuestion));
    CHECK_FALSE(has_warning(warnings, "the sessions differ"));
  }
}

TEST_CASE("sessions on two roads that slope differently are not asked for their headings", "[slow]") {
  const CoastdownData data = tests::join_sessions(make_sloped_study(0.006, 0.0), make_sloped_study(-0.002, 0.0));
  CHECK_FALSE(has_warning(tests::fit_checked(data), kQuestion));
}

namespace {

/// Two sessions of four pairs whose runs show `slopes` with a scatter, positive uphill in the + heading as recorded.
std::optional<std::string> ask_for_headings(double first_slope, double second_slope, double sd, std::uint64_t seed) {
  constexpr double kMass_kg = 1500.0;
  RandomStream random(seed, "slopes of runs");
  CoastdownData data;
  std::vector<estimation::RunResistance> runs;
  for (std::size_t i = 0; i < 16; ++i) {
    data.runs.emplace_back();
    data.runs.back().session = i < 8 ? "am" : "pm";
    data.runs.back().heading = i % 2 == 0 ? +1 : -1;
    const double slope = (i < 8 ? first_slope : second_slope) + sd * random.normal();
    estimation::RunResistance run{i, {}, {}};
    for (double speed_m_s = 5.0; speed_m_s < 36.0; speed_m_s += 2.5) {
      run.speed_m_s.push_back(speed_m_s);
      run.force_N.push_back(120.0 + 0.4 * speed_m_s * speed_m_s +
                            data.runs.back().heading * kMass_kg * kStandardGravity_m_s2 * slope);
    }
    runs.push_back(run);
  }
  return estimation::doubt_session_headings(data, runs, kMass_kg);
}

}  // namespace

TEST_CASE("runs that scatter on a level road are hardly ever asked for the headings of their sessions", "[fast]") {
  // The means of sessions scatter by 0.0021: without the limit by Student's t, one set in ten would be asked.
  int asked = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    asked += ask_for_headings(0.0, 0.0, 0.006, seed).has_value() ? 1 : 0;
  CHECK(asked <= 1);
}

TEST_CASE("the slopes of exchanged headings are those of the road, and slopes of other sizes are not asked for",
          "[fast]") {
  const auto asked = ask_for_headings(0.003, -0.003, 1e-6, 1);
  REQUIRE(asked.has_value());
  CHECK_THAT(*asked, Catch::Contains("+0.0030 in session 'am'") && Catch::Contains("-0.0030 in session 'pm'"));
  CHECK(ask_for_headings(0.003, -0.0016, 1e-6, 1).has_value());
  CHECK_FALSE(ask_for_headings(0.003, -0.0014, 1e-6, 1).has_value());   // by more than a factor of two
  CHECK_FALSE(ask_for_headings(0.0009, -0.0009, 1e-6, 1).has_value());  // below 0.001
  CHECK_FALSE(ask_for_headings(0.003, 0.003, 1e-6, 1).has_value());
}
