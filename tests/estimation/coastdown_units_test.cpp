#include "estimation/road_load/coastdown_units.h"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "sim/core/error.h"
#include "tests/support/coastdown_study.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

/// Coastdowns whose times are written as multiples of a unit of this length, with their column.
CoastdownFile make_coasts_in(double unit_s, bool is_trace, double speed_factor = 1.0) {
  tests::CoastdownStudy study;
  study.pairs = 2;
  CoastdownFile file;
  file.path = "coast.csv";
  file.is_trace = is_trace;
  file.data = tests::simulate_coastdowns(study, 1);
  if (!is_trace) file.data = tests::cut_into_bins(file.data, 10.0);
  for (CoastdownRun& run : file.data.runs) {
    for (double& time_s : run.time_s) time_s /= unit_s;
    for (double& speed_m_s : run.speed_m_s) speed_m_s *= speed_factor;
    for (SpeedBin& bin : run.bins) bin.duration_s /= unit_s;
  }
  return file;
}

}  // namespace

TEST_CASE("times of coastdowns in minutes, hours or milliseconds are refused, and the unit is guessed", "[fast]") {
  for (const bool is_trace : {true, false}) {
    const char* column = is_trace ? "time_s" : "dt_s";
    INFO(column);
    CHECK_NOTHROW(require_coasting_decelerations(make_coasts_in(1.0, is_trace)));
    const std::pair<double, const char*> cases[]{{60.0, "minutes"}, {3600.0, "hours"}, {1e-3, "ms"}};
    for (const auto& [unit_s, name] : cases) {
      CHECK_THROWS_WITH(require_coasting_decelerations(make_coasts_in(unit_s, is_trace)),
                        Contains(fmt::format("{} looks as if it were in {}", column, name)) && Contains("coast.csv") &&
                            Contains("m/s2, the median deceleration"));
    }
    CHECK_THROWS_WITH(require_coasting_decelerations(make_coasts_in(1e-6, is_trace)),
                      Contains("are times and speeds in the units of their columns?") && Contains(column));
  }
}

TEST_CASE("vehicles that coast slowly or brake early are not refused for their deceleration", "[fast]") {
  for (const double factor : {0.1, 8.0}) {  // of a usual deceleration
    CHECK_NOTHROW(require_coasting_decelerations(make_coasts_in(1.0, true, factor)));
  }
  CoastdownFile one_wrong = make_coasts_in(1.0, true);
  for (double& time_s : one_wrong.data.runs.front().time_s) time_s /= 60.0;  // an odd run, but not the unit of the file
  CHECK_NOTHROW(require_coasting_decelerations(one_wrong));
  CoastdownFile standing = make_coasts_in(1.0, true);
  for (CoastdownRun& run : standing.data.runs) {  // driven before, and standing for an hour after
    run.time_s.insert(run.time_s.begin(), run.time_s.front() - 3600.0);
    run.speed_m_s.insert(run.speed_m_s.begin(), run.speed_m_s.front());
    run.time_s.push_back(run.time_s.back() + 3600.0);
    run.speed_m_s.push_back(0.0);
  }
  CHECK_NOTHROW(require_coasting_decelerations(standing));
}

TEST_CASE("which of two speed columns is in another unit is told by their ratio", "[fast]") {
  CHECK(guess_speed_unit(0.62, "a", "b", 0.03) == "; a looks as if it were in mph");
  CHECK(guess_speed_unit(1.61, "a", "b", 0.03) == "; b looks as if it were in mph");
  CHECK(guess_speed_unit(0.28, "a", "b", 0.03) == "; a looks as if it were in m/s");
  CHECK(guess_speed_unit(3.6, "a", "b", 0.03) == "; b looks as if it were in m/s");
  CHECK(guess_speed_unit(1.0, "a", "b", 0.03).empty());
  CHECK(guess_speed_unit(0.58, "a", "b", 0.03).empty());
  CHECK_FALSE(guess_speed_unit(0.58, "a", "b", 0.1).empty());
}

TEST_CASE("times since the beginning of a run in place of times through bins are refused", "[fast]") {
  for (const double width_km_h : {2.0, 5.0, 10.0, 20.0}) {
    tests::CoastdownStudy study;
    study.pairs = 2;
    study.load = {70.0, 0.0, 0.035 * 12.96};  // falls far from bin to bin
    CoastdownFile file;
    file.path = "coast.csv";
    file.data = tests::cut_into_bins(tests::simulate_coastdowns(study, 1), width_km_h);
    CHECK_NOTHROW(require_coasting_decelerations(file));
    for (CoastdownRun& run : file.data.runs) {
      double sum_s = 0.0;
      for (SpeedBin& bin : run.bins) bin.duration_s = sum_s += bin.duration_s;
    }
    CHECK_THROWS_WITH(require_coasting_decelerations(file),
                      Contains("dt_s looks as if it were the time since the beginning of each run"));
  }
}

TEST_CASE("speeds in m/s are doubted by how decelerations fall, slow vehicles are not", "[fast]") {
  tests::CoastdownStudy study;
  study.interval_s = 0.5;
  study.pairs = 2;
  CoastdownData data = tests::simulate_coastdowns(study, 1);
  CHECK_FALSE(doubt_speeds_in_m_s(data).has_value());
  for (CoastdownRun& run : data.runs) {
    for (double& speed_m_s : run.speed_m_s) speed_m_s /= 3.6;
  }
  CHECK_THAT(*doubt_speeds_in_m_s(data), Contains("is speed_km_h in m/s?"));
  for (const double from_km_h : {30.0, 45.0, 59.0}) {
    study.from_km_h = from_km_h;
    study.to_km_h = 5.0;
    CHECK_FALSE(doubt_speeds_in_m_s(tests::simulate_coastdowns(study, 1)).has_value());
  }
}
