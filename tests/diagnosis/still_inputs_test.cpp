// Inputs that stand still although they should move are told from those that a laboratory holds.
#include "diagnosis/checks/still_inputs.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/checks/set_checks.h"
#include "sim/core/units.h"
#include "tests/diagnosis/checked_sets.h"
#include "tests/diagnosis/driving_sets.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::find_still_inputs;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

namespace {

/// Trips of several days whose thermometer shows half degrees.
MeasurementSet make_trips() {
  MeasurementSet set = tests::make_road_set({}, 4);
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    MeasuredRun& run = set.runs[r];
    run.session = "day " + std::to_string(r);
    std::vector<double>& ambient_K = run.columns.at("ambient_degC");
    for (std::size_t row = 0; row < ambient_K.size(); ++row) {
      const double moved_K = 2.0 * std::sin(run.time_s[row] / 150.0);
      ambient_K[row] = kZeroCelsius_K + 0.5 * std::round(2.0 * (ambient_K[row] - kZeroCelsius_K + moved_K));
    }
  }
  return set;
}

void hold(MeasuredRun& run, double degC) {
  for (double& ambient_K : run.columns.at("ambient_degC")) ambient_K = kZeroCelsius_K + degC;
}

}  // namespace

TEST_CASE("a temperature that moves is not accused", "[fast]") { CHECK(find_still_inputs(make_trips()).empty()); }

TEST_CASE("a laboratory that holds its air is not accused", "[fast]") {
  MeasurementSet set = tests::short_set();
  for (MeasuredRun& run : set.runs) hold(run, 25.0);
  CHECK(find_still_inputs(set).empty());
  MeasurementSet dyno = tests::make_dyno_set({}, 2);
  for (MeasuredRun& run : dyno.runs) hold(run, 25.0);
  CHECK(find_still_inputs(dyno).empty());
}

TEST_CASE("a temperature stuck on one trip is named, and no cause is", "[fast]") {
  for (const double degC : {20.0, 25.0}) {
    MeasurementSet set = make_trips();
    hold(set.runs[2], degC);
    const auto still = find_still_inputs(set);
    REQUIRE(still.size() == 1);
    CHECK(still[0].is_certain);
    CHECK(still[0].runs == std::vector<std::size_t>{2});
    const auto checks = diagnosis::check_set(set);
    CHECK(checks.is_implausible());
    CHECK(checks.mistaken_runs == std::vector<std::size_t>{2});
    CHECK_THAT(checks.doubt,
               Contains("ambient_degC stands at") && Contains("run " + set.runs[2].id) && !Contains("holds"));
  }
}

TEST_CASE("a temperature stuck on all trips is named where the tires began at others", "[fast]") {
  MeasurementSet set = make_trips();
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    set.runs[r].initial_tire_temperature_K = kZeroCelsius_K + 5.0 + 4.0 * static_cast<double>(r);
    hold(set.runs[r], 20.0);
  }
  const auto still = find_still_inputs(set);
  REQUIRE(still.size() == 1);
  CHECK(still[0].is_certain);
  CHECK_THAT(still[0].text, Contains("all runs"));
}

TEST_CASE("one number on all trips is a doubt and no verdict where nothing contradicts it", "[fast]") {
  MeasurementSet set = make_trips();
  for (MeasuredRun& run : set.runs) {
    run.initial_tire_temperature_K = kZeroCelsius_K + 20.0;
    hold(run, 20.0);
  }
  const auto still = find_still_inputs(set);
  REQUIRE(still.size() == 1);
  CHECK_FALSE(still[0].is_certain);
  const auto checks = diagnosis::check_set(set);
  CHECK_FALSE(checks.is_implausible());
  CHECK_THAT(tests::join(checks.warnings), Contains("ambient_degC stands at 20 degC"));
}

TEST_CASE("a height that stands still on one trip is named", "[fast]") {
  MeasurementSet set = make_trips();
  for (double& height_m : set.runs[1].columns.at("elevation_m")) height_m = 0.0;
  const auto still = find_still_inputs(set);
  REQUIRE(still.size() == 1);
  CHECK(still[0].column == models::quantities::kElevation);
}
