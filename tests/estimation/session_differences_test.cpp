// What is said of sessions that differ, and what is not said of those that do not.
#include "estimation/road_load/session_differences.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "estimation/road_load/checked_road_load.h"
#include "estimation/road_load/road_load_procedure.h"
#include "sim/core/random.h"
#include "sim/core/units.h"
#include "tests/support/coastdown_study.h"
#include "tests/support/fit_study.h"
#include "tests/support/session_study.h"

using namespace rollrig;
using estimation::CoastdownData;
using estimation::CoastdownRun;
using estimation::RoadLoadFit;
using estimation::RoadLoadProcedure;
using tests::fit_checked;
using tests::fit_traces;
using tests::join_sessions;

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

/// Two sessions of three pairs, the second with 20 N more at all speeds.
CoastdownData make_two_levels() {
  tests::CoastdownStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 1.0;
  tests::CoastdownStudy high = study;
  high.load.A_N += 20.0;
  return join_sessions(study, high);
}

RoadLoadFit fit_study(const CoastdownData& data) {
  estimation::RoadLoadFitOptions options;
  options.mass_kg = tests::CoastdownStudy().mass_kg;
  return estimation::fit_road_load(data, options);
}

bool holds_both(const RoadLoadFit& fit, int coefficient, double low, double high) {
  const auto [lower, upper] = fit.interval_95(coefficient);
  return lower <= low && high <= upper;
}

/// Runs that scatter, twenty sessions of one pair; every other one with `factor` times the force.
CoastdownData make_sessions_of_pairs(double factor, double wind_sd_m_s, std::uint64_t seed) {
  CoastdownData data;
  RandomStream random(seed, "winds of sessions");
  for (std::uint64_t session = 0; session < 20; ++session) {
    tests::CoastdownStudy study;
    study.pairs = 1;
    study.interval_s = 0.5;
    study.run_force_sd_N = 3.0;
    study.wind_m_s = wind_sd_m_s * random.normal();
    if (session % 2 == 1) {
      study.load = {factor * study.load.A_N, factor * study.load.B_N_s_per_m, factor * study.load.C_N_s2_per_m2};
    }
    for (CoastdownRun& run : tests::simulate_coastdowns(study, 100 * seed + session).runs) {
      run.session = std::to_string(session);
      data.runs.push_back(run);
    }
  }
  return data;
}

/// Of so many sets whose sessions differ by nothing but their winds, how many are doubted.
int count_windy_doubted(std::uint64_t sets) {
  int doubted = 0;
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    doubted += tests::has_warning(fit_traces(make_sessions_of_pairs(1.0, 0.3, seed)), "the sessions differ") ? 1 : 0;
  }
  return doubted;
}

struct Held {
  int f0 = 0, f2 = 0;
};

/// Of so many sets of three sessions that differ by a share, how many have an interval that holds the true f0 and f2.
Held count_held(std::uint64_t sets) {
  Held held;
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    RandomStream random(seed, "shares of sessions");
    CoastdownData data;
    for (const char* session : {"a", "b", "c"}) {
      const double share = 1.0 + 0.04 * random.normal();
      tests::CoastdownStudy study;
      study.pairs = 3;
      study.interval_s = 0.5;
      study.run_force_sd_N = 3.0;
      study.load = {120.0 * share, 0.0, 0.03 * 12.96 * share};
      const std::uint64_t seed_of_session = 10 * seed + static_cast<std::uint64_t>(*session);
      for (CoastdownRun& run : tests::simulate_coastdowns(study, seed_of_session).runs) {
        run.session = session;
        data.runs.push_back(run);
      }
    }
    const RoadLoadProcedure found = fit_traces(data);
    const auto holds = [&found](int i, double truth) {
      return found.interval_95(i)[0] <= truth && truth <= found.interval_95(i)[1] ? 1 : 0;
    };
    held.f0 += holds(0, 120.0);
    held.f2 += holds(2, 0.03 * 12.96);
  }
  return held;
}

}  // namespace

TEST_CASE("sessions that differ by a share of the force: it is said, and the intervals hold both", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 3;
  study.run_force_sd_N = 1.0;
  tests::CoastdownStudy high = study;
  high.load = {1.2 * study.load.A_N, 1.2 * study.load.B_N_s_per_m, 1.2 * study.load.C_N_s2_per_m2};
  const CoastdownData data = join_sessions(study, high);
  const RoadLoadFit fit = fit_study(data);
  // 1 and 1.2 times the same: a standard deviation of 0.1414 about a mean of 1.1
  CHECK(fit.scatter.session_share.value_or(0.0) == Approx(0.1414 / 1.1).epsilon(0.1));
  CHECK_FALSE(fit.scatter.session_force_N.has_value());
  CHECK(tests::has_warning(fit, "the sessions differ by a standard deviation of 12."));
  CHECK(holds_both(fit, 0, study.load.A_N, high.load.A_N));
  CHECK(holds_both(fit, 2, study.load.C_N_s2_per_m2, high.load.C_N_s2_per_m2));
}

TEST_CASE("sessions that differ by the same force at all speeds widen A, and not C", "[fast]") {
  const RoadLoadFit fit = fit_study(make_two_levels());
  CHECK(fit.scatter.session_force_N.value_or(0.0) == Approx(20.0 / std::sqrt(2.0)).epsilon(0.1));
  CHECK_FALSE(fit.scatter.session_share.has_value());
  const double A_N = tests::CoastdownStudy().load.A_N;
  CHECK(holds_both(fit, 0, A_N, A_N + 20.0));
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

TEST_CASE("sessions that differ make the coefficients of each heading alone as uncertain", "[fast]") {
  const RoadLoadFit fit = fit_study(make_two_levels());
  REQUIRE(fit.headings.size() == 2);
  // the mean of two sessions that scatter by 20/sqrt(2) N
  for (const auto& heading : fit.headings) CHECK(heading.estimate.sd(0) > 0.8 * 10.0);
}

TEST_CASE("headings that differ as in a storm are doubted", "[fast]") {
  tests::CoastdownStudy study;
  CoastdownData data = tests::simulate_coastdowns(study, 1);
  for (CoastdownRun& run : data.runs) {
    if (run.heading < 0) continue;
    for (double& time_s : run.time_s) time_s /= 4.0;
  }
  CHECK(tests::has_warning(fit_study(data), "in which nobody coasts down"));
  CHECK_FALSE(tests::has_warning(fit_study(tests::simulate_coastdowns(study, 1)), "nobody coasts"));
}

TEST_CASE("a braked run is named beside a session that differs", "[slow]") {
  tests::CoastdownStudy study;
  study.run_force_sd_N = 3.0;
  tests::CoastdownStudy other = study;
  other.load.A_N *= 1.3;
  CoastdownData data = join_sessions(study, other);
  for (double& time_s : data.runs[13].time_s) time_s *= 0.75;
  const RoadLoadFit fit = fit_checked(data);
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].runs == std::vector<std::string>{data.runs[13].id});
  CHECK(fit.doubts[0].relative == Approx(1.0 / 0.75 - 1.0).epsilon(0.2));
}

TEST_CASE("sessions of one pair are compared, by what their headings have in common", "[slow]") {
  CHECK(tests::has_warning(fit_traces(make_sessions_of_pairs(1.1, 0.3, 1)), "the sessions differ"));
}

TEST_CASE("sessions of one pair that differ by several percent always have a fit", "[slow]") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random(seed, "factors of sessions");
    CoastdownData data;
    for (std::uint64_t session = 0; session < 4; ++session) {
      const double factor = 1.0 + 0.08 * random.normal();
      tests::CoastdownStudy study;
      study.pairs = 1;
      study.interval_s = 1.0;
      study.run_force_sd_N = 3.0;
      study.run_wind_sd_m_s = 0.2;
      study.gust_N_sqrt_s = 10.0;
      study.load = {factor * study.load.A_N, factor * study.load.B_N_s_per_m, factor * study.load.C_N_s2_per_m2};
      for (CoastdownRun& run : tests::simulate_coastdowns(study, 10 * seed + session).runs) {
        run.session = std::to_string(session);
        data.runs.push_back(run);
      }
    }
    INFO(seed);
    CHECK_NOTHROW(fit_study(data));
  }
}

TEST_CASE("sessions of one pair with winds of their own do not differ", "[slow]") {
  CHECK(count_windy_doubted(10) <= 1);
}

TEST_CASE("of thirty sets of sessions with winds of their own hardly one is doubted", "[weekly]") {
  CHECK(count_windy_doubted(30) <= 2);
}

TEST_CASE("traces of sessions that differ by a share: the intervals of f0 and f2 mostly hold the truth", "[slow]") {
  const Held held = count_held(20);
  CHECK(held.f0 >= 16);  // 19 on average; fewer than 16 in one of four hundred
  CHECK(held.f2 >= 16);
}

TEST_CASE("traces of sessions that differ by a share: the intervals of f0 and f2 hold the truth at their rate",
          "[weekly]") {
  const Held held = count_held(60);
  CHECK(held.f0 >= 53);  // 57 on average; fewer than 53 in one of fifty
  CHECK(held.f2 >= 53);
}

namespace {

/// Runs by session and heading with these deviations in %.
struct Deviations {
  CoastdownData data;
  std::map<std::size_t, double> values;
  void add(const std::string& session, int heading, const std::vector<double>& percent) {
    for (const double value : percent) {
      values[data.runs.size()] = 0.01 * value;
      data.runs.emplace_back();
      data.runs.back().session = session;
      data.runs.back().heading = heading;
    }
  }
};

}  // namespace

TEST_CASE("the F test of sessions is that of a table", "[fast]") {
  using estimation::compare_sessions;
  using estimation::SessionWinds;
  // means 1.5 and 6.5; within squares 8 with 4 degrees of freedom; F(1, 4) = 25: p = 0.00749
  Deviations repeated;
  repeated.add("a", +1, {0, 2});
  repeated.add("a", -1, {1, 3});
  repeated.add("b", +1, {5, 7});
  repeated.add("b", -1, {6, 8});
  const auto found = compare_sessions(repeated.data, repeated.values, SessionWinds::kInDeviations);
  REQUIRE(found.has_value());
  CHECK(found->p_value == Approx(0.00749).epsilon(1e-3));
  CHECK(found->relative_sd == Approx(0.05 / std::sqrt(2.0)));
  CHECK(found->farthest == "b");
  CHECK(found->other == "a");
  CHECK(found->relative == Approx(0.05));
  // one run of each heading: means 0.5 and 5.5, rest +-0.5 four times; F(1, 1) = 25: p = 0.1257
  Deviations pairs;
  pairs.add("a", +1, {0});
  pairs.add("a", -1, {1});
  pairs.add("b", +1, {4});
  pairs.add("b", -1, {7});
  const auto of_pairs = compare_sessions(pairs.data, pairs.values, SessionWinds::kInDeviations);
  REQUIRE(of_pairs.has_value());
  CHECK(of_pairs->p_value == Approx(0.1257).epsilon(1e-3));
  CHECK_FALSE(compare_sessions(pairs.data, pairs.values, SessionWinds::kFitted).has_value());
  // each run its own session: nothing to compare
  Deviations single;
  single.add("a", +1, {0});
  single.add("b", -1, {1});
  single.add("c", +1, {4});
  CHECK_FALSE(compare_sessions(single.data, single.values, SessionWinds::kInDeviations).has_value());
}

TEST_CASE("one repeated run does not blunt the test of single pairs", "[fast]") {
  Deviations twenty;
  for (int session = 0; session < 20; ++session) {
    const double level = session % 2 == 0 ? 0.0 : 10.0;
    twenty.add(std::to_string(session), +1, {level + 0.1 * (session % 3)});
    twenty.add(std::to_string(session), -1, {level + 0.1 * (session % 5)});
  }
  twenty.add("0", +1, {0.3});
  const auto found = estimation::compare_sessions(twenty.data, twenty.values, estimation::SessionWinds::kInDeviations);
  REQUIRE(found.has_value());
  CHECK(found->p_value < 1e-6);
}

TEST_CASE("bins of three sessions that differ: the interval of A has the freedom of three sessions", "[slow]") {
  CoastdownData data;
  RandomStream random(3, "noise of bins");
  for (const auto& [session, more_N] : {std::pair("a", -15.0), std::pair("b", 15.0), std::pair("c", 40.0)}) {
    tests::CoastdownStudy study;
    study.run_force_sd_N = 1.0;
    study.noise_sd_m_s = 0.0;
    study.resolution_km_h = 0.0;
    study.load.A_N += more_N;
    const auto seed = static_cast<std::uint64_t>(*session);
    for (CoastdownRun& run : tests::cut_into_bins(tests::simulate_coastdowns(study, seed), 5.0).runs) {
      for (auto& bin : run.bins) bin.duration_s += 0.02 * random.normal();
      run.session = session;
      data.runs.push_back(run);
    }
  }
  const RoadLoadFit fit = fit_study(data);
  CHECK(fit.sd(0) > 12.0);  // of levels that scatter by 27.5 N, over sqrt(3): 15.9
  CHECK(fit.degrees_freedom[0] < 3.0);
  CHECK(fit.scatter.session_force_N.value_or(0.0) == Approx(27.5).epsilon(0.1));
}

TEST_CASE("a session of one run weighs as a session, not as all the others", "[slow]") {
  tests::CoastdownStudy study;
  study.run_force_sd_N = 1.0;
  tests::CoastdownStudy high = study;
  high.load.A_N += 30.0;
  CoastdownData data = join_sessions(study, high);
  tests::CoastdownStudy higher = study;
  higher.load.A_N += 55.0;
  data.runs.push_back(tests::simulate_coastdowns(higher, 5).runs.front());
  data.runs.back().session = "night";
  const RoadLoadFit fit = fit_study(data);
  CHECK(fit.load.A_N == Approx(study.load.A_N + 85.0 / 3.0).margin(6.0));
  CHECK(fit.sd(0) > 12.0);
  CHECK(tests::has_warning(fit, "one heading only in session 'night'"));
}

TEST_CASE("traces of sessions that are headings have a result, and it is said what its intervals lack", "[fast]") {
  tests::CoastdownStudy study;
  study.pairs = 4;
  study.run_force_sd_N = 3.0;
  CoastdownData data = tests::simulate_coastdowns(study, 1);
  for (CoastdownRun& run : data.runs) run.session = run.heading > 0 ? "am" : "pm";
  const RoadLoadProcedure found = fit_traces(data);
  CHECK(tests::has_warning(found, "how sessions differ is not in the intervals"));
  CHECK(found.road_load(2) == Approx(study.load.C_N_s2_per_m2).epsilon(0.25));  // J1263 has no term of B
}

TEST_CASE("the scatter between sessions of traces is a force or a share, as made", "[fast]") {
  tests::CoastdownStudy study;
  study.load.B_N_s_per_m = 0.0;
  study.pairs = 4;
  study.run_force_sd_N = 1.0;
  const auto find = [](const RoadLoadProcedure& procedure, const std::string& key) {
    for (const auto& further : procedure.further) {
      if (further.key == key) return further.value;
    }
    return 0.0;
  };
  tests::CoastdownStudy high = study;
  high.load.A_N += 20.0;
  const RoadLoadProcedure by_force = fit_traces(join_sessions(study, high));
  CHECK(find(by_force, "session_to_session_N") == Approx(20.0 / std::sqrt(2.0)).epsilon(0.1));
  CHECK(find(by_force, "session_to_session_share") == 0.0);
  high.load = {1.2 * study.load.A_N, 0.0, 1.2 * study.load.C_N_s2_per_m2};
  const RoadLoadProcedure by_share = fit_traces(join_sessions(study, high));
  CHECK(find(by_share, "session_to_session_share") == Approx(0.1414 / 1.1).epsilon(0.1));
  CHECK(find(by_share, "session_to_session_N") == 0.0);
  // 0.2 km/h moves forces by less than 2 %, not by the difference of two models of the sessions
  for (const auto& sensor : by_share.sensors) CHECK(std::abs(sensor.change(0)) < 0.02 * study.load.A_N);
}

TEST_CASE("the session that is farthest from the others is named, with its sign", "[fast]") {
  // level of each run; sessions a, b and c, the last 3 % below
  CoastdownData data;
  std::map<std::size_t, double> deviations;
  for (std::size_t i = 0; i < 12; ++i) {
    data.runs.emplace_back();
    data.runs.back().session = std::string(1, static_cast<char>('a' + i / 4));
    data.runs.back().heading = i % 2 == 0 ? +1 : -1;
    deviations[i] = (i / 4 == 2 ? -0.03 : 0.0) + (i / 2 % 2 == 0 ? 0.001 : -0.001);
  }
  const auto found = estimation::compare_sessions(data, deviations, estimation::SessionWinds::kFitted);
  REQUIRE(found.has_value());
  CHECK(found->farthest == "c");
  CHECK(found->relative == Approx(-0.03));
  CHECK(found->relative_sd == Approx(0.03 / std::sqrt(3.0)));
  CHECK(found->p_value < 1e-6);
}
