#include <fmt/format.h>

#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/test_plan.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kScale_kg = 10.0;  // Assumed: standard uncertainty of a weighbridge

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

/// A vehicle in neutral, which no force of its motor drives.
PlannedTest road_coastdown(const PreparedSet& set, const TestConditions& at) {
  constexpr int kRoadCoasts = 6;      // Assumed: three each way, as road loads are measured
  constexpr double kRolling = 0.007;  // Assumed, as the density: near enough for how fast the speed falls
  constexpr double kDensity_kg_m3 = 1.2;
  const models::VehicleBody<double>& body = set.context().vehicle;
  const auto calc_slowing_m_s2 = [&](double speed_m_s) {
    const double rolling_N = kRolling * body.mass_kg * kStandardGravity_m_s2;
    const double drag_N = 0.5 * kDensity_kg_m3 * body.drag_area_m2 * speed_m_s * speed_m_s;
    return (rolling_N + drag_N) / (body.mass_kg + body.rotating_mass_kg);
  };
  RunPlan run = begin_warm(at);
  for (int i = 0; i < kRoadCoasts; ++i) {
    run.roll(0.5, at.load_N, 120.0, false).coast(at.load_N, 25.0, calc_slowing_m_s2);
  }
  PlannedTest test =
      make_test("coastdown", "coastdown from 120 to 25 km/h in neutral on a level road, six times, all warm", 0, {run});
  test.by_hand = {
      "Shift to neutral and let the vehicle coast, three times each way; while it coasts its traction force is 0: "
      "write "
      "0 where the motor's torque is not logged."};
  return test;
}

PlannedTest weighed_coastdown(const PreparedSet& set, const TestConditions& at) {
  constexpr double kScale_h = 0.5;  // Assumed: way to a weighbridge
  PlannedTest test = road_coastdown(set, at);
  test.id = "weighed_coastdown";
  test.description = "vehicle weighed on a scale as it drives, then " + test.description;
  for (std::size_t i = 0; i < test.runs.size(); ++i) test.runs[i].id = fmt::format("{}-{}", test.id, i + 1);
  test.hours += kScale_h;
  test.numbers = {{"vehicle.mass_kg", kScale_kg}};
  test.by_hand.push_back(fmt::format(
      "Weigh the vehicle with driver and load, and put the weight into vehicle.toml: mass_kg, and mass_kg_sd = {:.0f}.",
      kScale_kg));
  return test;
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
  menu.push_back(road_coastdown(set, at));
  menu.push_back(weighed_coastdown(set, at));
  const std::size_t count = menu.size();
  for (std::size_t i = 0; i < count; ++i) menu.push_back(repeat(menu[i]));
  return menu;
}

}  // namespace rollrig::diagnosis
