// How often mistakes that are planted in measured and in made sets are found, rightly named, and laid on innocent runs.
// The bars: 90 % rightly named (knots: found), at most 1 % of innocent runs accused. ROLLRIG_PLANTINGS sets the number
// of each.
#include "tests/diagnosis/planted_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

#include "build_paths.h"
#include "diagnosis/checks/set_checks.h"
#include "tests/diagnosis/checked_sets.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/support/fit_study.h"
#include "tests/validation/generator/generated_set.h"

namespace fs = std::filesystem;
using namespace rollrig;
using measurements::MeasurementSet;
using tests::PlantedMistake;
using tests::PlantedScore;

namespace {

/// The measured trips that are as they should be; none where they are not at hand.
std::optional<MeasurementSet> read_trips() {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path path = fs::path(folder != nullptr ? folder : ROLLRIG_SOURCE_DIR "/../shared/data/measured") /
                        "road_trips_i3" / "set.toml";
  if (!fs::exists(path)) return std::nullopt;
  MeasurementSet set = measurements::read_measurement_set(path.string());
  const auto is_interpolated = [](const measurements::MeasuredRun& run) { return run.id == "b02"; };
  set.runs.erase(std::remove_if(set.runs.begin(), set.runs.end(), is_interpolated), set.runs.end());
  return set;
}

std::vector<MeasurementSet> draw_sets(const MeasurementSet& set, int count, std::size_t runs) {
  std::mt19937_64 random(11);
  std::vector<MeasurementSet> sets;
  for (int i = 0; i < count; ++i) sets.push_back(tests::draw_runs(set, runs, random));
  return sets;
}

void require_bars(const std::string& of, const PlantedMistake& mistake, const std::vector<MeasurementSet>& sets) {
  const PlantedScore score = tests::score(mistake, sets, 5);
  std::cout << fmt::format("{:10} {:45} planted {:3} found {:3} named {:3}, of {:4} innocent runs accused {}\n", of,
                           mistake.name, score.planted, score.found, score.named, score.innocent, score.accused);
  INFO(of << " " << mistake.name << "\n" << tests::join(score.misses));
  // Knots are 15 % more than mph, which an effect may be as well, and cars and rigs are hardly measured in knots.
  const bool is_knots = mistake.words == "holds knots";
  CHECK(10 * (is_knots ? score.found : score.named) >= 9 * score.planted);
  CHECK(100 * score.accused <= score.innocent);
}

void require_bars_of_all(const std::string& of, const MeasurementSet& set, int count, std::size_t runs) {
  const std::vector<MeasurementSet> sets = draw_sets(set, count, runs);
  for (const MeasurementSet& clean : sets) CHECK_FALSE(diagnosis::check_set(clean).is_implausible());
  for (const PlantedMistake& mistake : tests::list_wrong_columns(set)) require_bars(of, mistake, sets);
  std::vector<std::string> columns{set.kind->traits.force.header()};
  if (set.kind->word == std::string("road")) columns.insert(columns.begin(), {"speed_km_h", "elevation_m"});
  require_bars(of, tests::make_interpolated(set, columns), sets);
}

}  // namespace

TEST_CASE("mistakes planted in measured trips are found and named", "[slow]") {
  const std::optional<MeasurementSet> trips = read_trips();
  if (!trips.has_value()) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const int count = tests::count_plantings(3);
  require_bars_of_all("measured", *trips, count, 8);
  const std::vector<MeasurementSet> sets = draw_sets(*trips, count, 8);
  for (const double degC : {20.0, 25.0}) {
    require_bars("measured", tests::make_still_column("ambient_degC", degC), sets);
  }
}

TEST_CASE("mistakes planted in made sets are found and named", "[slow]") {
  const int count = tests::count_plantings(2);
  tests::Campaign campaign = tests::make_wide_campaign();
  campaign.effects = {tests::make_effect_at("bearing_warmup", 0.5)};
  require_bars_of_all("drum", tests::simulate_campaign(campaign, 3), count, 4);
  require_bars_of_all("dyno", tests::make_generated_set("--kind dyno --effect none --seed 3").set, count, 4);
  const auto warming = tests::make_effect_at("tire_temperature", 0.6);
  require_bars_of_all("road", tests::add_noise(tests::make_road_set({warming}, 6), 4), count, 6);
}

TEST_CASE("two mistakes in two runs, and two in one, are told apart", "[slow]") {
  const MeasurementSet clean = tests::add_noise(tests::make_road_set({}, 6), 4);
  const std::vector<PlantedMistake> mistakes = tests::list_wrong_columns(clean);
  const auto find = [&](const std::string& words) {
    return *std::find_if(mistakes.begin(), mistakes.end(),
                         [&](const PlantedMistake& one) { return one.words == words; });
  };
  std::mt19937_64 random(1);
  MeasurementSet set = clean;
  find("holds mph").plant(set.runs[1], random);
  find("holds the torque at the wheels").plant(set.runs[4], random);
  std::string text = tests::answer_to(set).text;
  CHECK_THAT(text, Catch::Contains("in run " + set.runs[1].id + " it looks as if speed_km_h holds mph"));
  CHECK_THAT(text, Catch::Contains("in run " + set.runs[4].id + " it looks as if traction_force_N holds the torque"));
  set = clean;
  find("holds mph").plant(set.runs[2], random);
  find("holds the torque at the wheels").plant(set.runs[2], random);
  text = tests::answer_to(set).text;
  CHECK_THAT(text, Catch::Contains("in run " + set.runs[2].id) && Catch::Contains("holds mph and") &&
                       Catch::Contains("holds the torque at the wheels"));
}
