// Sets measured on the road, diagnosed: simulated ones, and real trips where they are at hand.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "build_paths.h"
#include "diagnosis/checks/set_checks.h"
#include "diagnosis/comparison/base_parameters.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "diagnosis/output/summary.h"
#include "sim/core/error.h"
#include "tests/diagnosis/answers.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_sets.h"
#include "tests/support/fit_study.h"

namespace fs = std::filesystem;
using namespace rollrig;
using diagnosis::Diagnosis;
using diagnosis::Verdict;
using tests::contains;
using tests::Ids;
using tests::make_road_set;
using tests::names;
using tests::only;

namespace {

/// Of a motor that is well logged on a smooth road: effects of some newtons show.
measurements::MeasurementSet with_quiet_sensor(measurements::MeasurementSet set) {
  set.sensors.at("traction_force_N") = {5.0, 15.0, 13.0, 20.0, 0.0};
  return set;
}

std::string find_trips() {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path set = fs::path(folder != nullptr ? folder : ROLLRIG_SOURCE_DIR "/../shared/data/measured") /
                       "road_trips_i3" / "set.toml";
  return fs::exists(set) ? set.string() : std::string();
}

}  // namespace

TEST_CASE("on the road noise alone is no gap", "[slow]") {
  const Diagnosis found = diagnosis::diagnose(tests::add_noise(make_road_set({}, 4), 3), {});
  INFO(diagnosis::format_summary(found));
  CHECK(found.verdict == Verdict::kNoGap);
  CHECK(found.probability.count("tire_temperature") == 1);
  CHECK(found.probability.count("wind_and_grade") == 1);
}

TEST_CASE("a tire that warms is named against a constant coefficient, on trips with the noise of a real road",
          "[slow]") {
  const auto set = tests::add_noise(make_road_set({tests::make_effect_at("tire_temperature", 0.6)}, 6), 4);
  const Diagnosis found = diagnosis::diagnose(set, {});
  INFO(diagnosis::format_summary(found));
  CHECK(names(found, "tire_temperature"));
  CHECK(found.gap.held_out.size() == 6);
}

TEST_CASE("wind is named where the traction force is well known", "[slow]") {
  const auto wind = tests::make_effect_at("wind_and_grade", 0.8);
  const auto set = tests::add_noise(with_quiet_sensor(make_road_set({wind}, 4)), 5);
  const Diagnosis found = diagnosis::diagnose(set, only({"wind_and_grade", "tire_temperature", "driveline_warming"}));
  INFO(diagnosis::format_summary(found));
  CHECK(names(found, "wind_and_grade"));
}

TEST_CASE("on the road the vehicle's own numbers are found again", "[fast]") {
  measurements::MeasurementSet set = make_road_set({}, 6);
  const auto base = diagnosis::find_base_parameters(set, measurements::make_context(set));
  Ids keys;
  for (const auto& one : base) keys.push_back(one.key);
  CHECK(keys ==
        Ids{"tire.constant.rrc_N_per_kN", "vehicle.drag_area_m2", "vehicle.mass_kg", "vehicle.rotating_mass_kg"});
  measurements::MeasurementSet heavy = set;
  tests::measure_again(heavy, {}, [](models::Context<double>& moved) { moved.vehicle.drag_area_m2 += 0.06; });
  for (std::size_t i = 0; i < set.runs.size(); ++i) {  // empty where the set is
    const auto& was = set.runs[i].columns.at("traction_force_N");
    auto& now = heavy.runs[i].columns.at("traction_force_N");
    for (std::size_t row = 0; row < was.size(); ++row) now[row] = std::isnan(was[row]) ? was[row] : now[row];
  }
  const tests::FittedBaseline fitted(tests::add_noise(with_quiet_sensor(heavy), 6));
  CHECK(base[1].prior_sd_SI * fitted.null.fit.unknowns[1] == Approx(0.06).epsilon(0.25));
}

TEST_CASE("a vehicle that is given by its road load cannot be diagnosed, and the file is named", "[fast]") {
  measurements::MeasurementSet set = make_road_set({}, 1);
  set.vehicle->path = "car.toml";
  set.vehicle->road_load = models::RoadLoad<double>{100.0, 0.0, 0.5};
  CHECK_THROWS_AS(diagnosis::diagnose(set, {}), InputError);
  CHECK_THROWS_WITH(diagnosis::diagnose(set, {}), Catch::Contains("car.toml") && Catch::Contains("drag_area_m2"));
}

TEST_CASE("units of a road set that cannot be are named", "[fast]") {
  measurements::MeasurementSet set = tests::add_noise(make_road_set({}, 2), 9);
  for (measurements::MeasuredRun& run : set.runs) {
    for (double& traction : run.columns.at("traction_force_N")) traction /= 1e3;
  }
  const auto checks = diagnosis::check_set(set);
  CHECK(checks.is_implausible());
  CHECK_THAT(checks.warnings.back(), Catch::Contains("traction_force_N holds kN"));
}

TEST_CASE("real trips against a constant coefficient", "[slow]") {
  const std::string path = find_trips();
  if (path.empty()) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const Diagnosis found = diagnosis::diagnose(measurements::read_measurement_set(path), {});
  std::cout << diagnosis::format_summary(found);
  // Weather, wind and load of a trip are not known: what is held to is that nothing is claimed beyond what holds up.
  // Without the stretch that was interpolated, what is left does not stand out of the noise: then no shrinkage is
  // stated.
  CHECK(found.gap.recalibrated.before < 0.5);
  CHECK(found.gap.held_out.size() == 20);
  if (found.gap.shrink_percent.has_value() && found.verdict == Verdict::kExplained) {
    CHECK(*found.gap.shrink_percent > 0.0);
  }
  CHECK(found.probability.at("none") < 0.5);
}

TEST_CASE("half of the real trips gives the same cause, or says that it cannot tell", "[slow]") {
  const std::string path = find_trips();
  if (path.empty()) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const measurements::MeasurementSet all = measurements::read_measurement_set(path);
  for (const std::size_t first : {0U, 1U}) {
    measurements::MeasurementSet half = all;
    half.runs.clear();
    for (std::size_t i = first; i < all.runs.size(); i += 2) half.runs.push_back(all.runs[i]);
    const Diagnosis found = diagnosis::diagnose(half, {});
    INFO(diagnosis::format_summary(found));
    if (found.verdict == Verdict::kExplained) CHECK(names(found, "tire_temperature"));
    CHECK(found.verdict != Verdict::kUnexplained);
  }
}
