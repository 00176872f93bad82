#include <fmt/format.h>

#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/test_plan.h"

namespace rollrig::diagnosis {
namespace {

PlannedTest road_steady_from_cold(const TestConditions& at) {
  return make_test("steady_from_cold", "80 km/h on a level road for 40 min, vehicle and tires cold", 1,
                   {begin_cold(at).roll(40.0, at.load_N)});
}

PlannedTest cold_air(const TestConditions& at) {
  constexpr double kColder_K = 15.0;  // Assumed: another season, or a night
  TestConditions cold = at;
  cold.ambient_K -= kColder_K;
  return make_test("cold_air", "80 km/h on a level road for 40 min from cold, in air 15 K colder", 1,
                   {begin_cold(cold).roll(40.0, at.load_N)});
}

PlannedTest warm_steps(const TestConditions& at) {
  return make_test("warm_steps", "80, then 120 and 50 km/h in turn, 6 min each, on a level road, all warm", 0,
                   {begin_warm(at).roll_at_speeds(6.0, at.load_N, {120.0, 50.0, 120.0, 50.0})});
}

PlannedTest road_ramps(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (int i = 0; i < 8; ++i) run.roll_at_speeds(0.5, at.load_N, {110.0, 50.0});
  return make_test("ramps", "ramps between 50 and 110 km/h by the motor alone, up and down, eight times, all warm", 0,
                   {run});
}

PlannedTest road_rests(const TestConditions& at) {
  RunPlan run = begin_cold(at).roll(30.0, at.load_N).stand(20.0, at.load_N).roll(15.0, at.load_N);
  return make_test("rests", "80 km/h after a night, after 20 min and after 1 h at rest", 1,
                   {run.stand(60.0, at.load_N).roll(15.0, at.load_N)});
}

/// The same on several days: wind and what else one day has drown what a single run shows.
PlannedTest repeat(const PlannedTest& once) {
  constexpr int kDays = 5;  // Assumed: a working week
  PlannedTest test = once;
  test.id += "_repeated";
  test.description += ", on five days";
  test.hours = kDays * once.hours;
  test.runs.clear();
  for (int day = 1; day <= kDays; ++day) {
    for (measurements::MeasuredRun run : once.runs) {
      run.session = fmt::format("next-{}", day);
      run.id = fmt::format("{}-{}", test.id, test.runs.size() + 1);
      test.runs.push_back(std::move(run));
    }
  }
  return test;
}

}  // namespace

std::vector<PlannedTest> make_road_tests(const PreparedSet& set) {
  TestConditions at = find_test_conditions(set);
  at.held = {{models::quantities::kElevation, 0.0}};
  std::vector<PlannedTest> menu;
  for (const auto make : {road_steady_from_cold, cold_air, warm_steps, road_ramps, road_rests})
    menu.push_back(make(at));
  const std::size_t count = menu.size();
  for (std::size_t i = 0; i < count; ++i) menu.push_back(repeat(menu[i]));
  return menu;
}

}  // namespace rollrig::diagnosis
