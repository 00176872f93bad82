// How often mistakes that are planted in measured and in made sets are found, rightly named, and laid on innocent runs.
// The bars: 90 % rightly named, or among those of which it is said that they cannot be told apart (knots on
// rollers: found); at most 1 % of innocent runs accused. ROLLRIG_PLANTINGS sets the number of each.
#include "tests/diagnosis/planted_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
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

/// Told: rightly named, or said that it cannot be told apart from another.
enum class Bar { kTold, kFound };

void require_score(const std::string& of, const std::string& name, const PlantedScore& score, Bar bar = Bar::kTold) {
  std::cout << fmt::format(
                   "{:10} {:45} planted {:3} found {:3} named {:3} untold {:3}, of {:4} innocent runs accused {}\n", of,
                   name, score.planted, score.found, score.named, score.untold, score.innocent, score.accused)
            << std::flush;
  INFO(of << " " << name << "\n" << tests::join(score.misses));
  CHECK(10 * (bar == Bar::kFound ? score.found : score.named + score.untold) >= 9 * score.planted);
  CHECK(100 * score.accused <= score.innocent);
}

void require_bars(const std::string& of, const PlantedMistake& mistake, const std::vector<MeasurementSet>& sets) {
  // On rollers and road, knots fall short (docs/diagnosis.md): they are 15 % more than mph and far rarer, and a tire
  // that warms as the simulation has it but roughly can make as much of a difference.
  const bool falls_short = (of == "dyno" || of == "road") && mistake.words == "holds knots";
  require_score(of, mistake.name, tests::score(mistake, sets, 5), falls_short ? Bar::kFound : Bar::kTold);
}

void require_bars_of_two(const std::string& of, const std::vector<MeasurementSet>& sets) {
  std::vector<PlantedMistake> mistakes = tests::list_wrong_columns(sets.front());
  mistakes.erase(std::remove_if(mistakes.begin(), mistakes.end(),
                                [](const PlantedMistake& one) { return one.words == "holds knots"; }),
                 mistakes.end());
  require_score(of, "two mistakes in two runs", tests::score_two(mistakes, sets, 5));
}

/// The same runs in air that warms and cools by half a degree, as a sensor of 0.1 K tells it.
MeasurementSet move_air(MeasurementSet set) {
  for (measurements::MeasuredRun& run : set.runs) {
    std::vector<double>& air_K = run.columns.at("ambient_degC");
    for (std::size_t row = 0; row < air_K.size(); ++row) {
      air_K[row] += 0.1 * std::round(5.0 * std::sin(run.time_s[row] / 200.0));
    }
  }
  return set;
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

TEST_CASE("exchanged columns, times in minutes and two mistakes, planted in measured trips", "[slow]") {
  const std::optional<MeasurementSet> trips = read_trips();
  if (!trips.has_value()) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const std::vector<MeasurementSet> sets = draw_sets(*trips, tests::count_plantings(2), 8);
  for (const PlantedMistake& mistake : tests::list_exchanged_columns(*trips)) require_bars("measured", mistake, sets);
  require_bars("measured", tests::make_minutes(), sets);
  require_bars_of_two("measured", sets);
  for (const double degC : {20.0, 25.0}) {
    const PlantedMistake still = tests::make_still_column("ambient_degC", degC);
    require_score("measured", still.name + " on all trips", tests::score_in_all(still, sets, 5));
  }
}

TEST_CASE("exchanged columns, times in minutes, still air and two mistakes, planted in made sets", "[slow]") {
  const int count = tests::count_plantings(2);
  tests::Campaign campaign = tests::make_wide_campaign();
  campaign.effects = {tests::make_effect_at("bearing_warmup", 0.5)};
  const auto warming = tests::make_effect_at("tire_temperature", 0.6);
  struct Made {
    const char* name;
    MeasurementSet set;
    std::size_t runs;
  };
  const Made all[] = {
      {"drum", tests::simulate_campaign(campaign, 3), 4},
      {"dyno", tests::make_generated_set("--kind dyno --effect none --seed 3").set, 4},
      {"road", move_air(tests::add_noise(tests::make_road_set({warming}, 6), 4)), 6},
  };
  for (const Made& made : all) {
    const std::vector<MeasurementSet> sets = draw_sets(made.set, count, made.runs);
    for (const PlantedMistake& mistake : tests::list_exchanged_columns(made.set))
      require_bars(made.name, mistake, sets);
    require_bars(made.name, tests::make_minutes(), sets);
    require_bars_of_two(made.name, sets);
    if (made.name != std::string("road")) continue;
    for (const double degC : {20.0, 25.0}) {
      const PlantedMistake still = tests::make_still_column("ambient_degC", degC);
      require_bars(made.name, still, sets);
      require_score(made.name, still.name + " on all trips", tests::score_in_all(still, sets, 5));
    }
  }
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
