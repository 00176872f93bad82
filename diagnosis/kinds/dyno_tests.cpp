#include <fmt/format.h>

#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/test_plan.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kRoadLoad_N = 150.0;  // Assumed: of one wheel at 80 km/h
constexpr double kHard_N = 1000.0;     // Assumed: what one wheel drives or brakes for minutes

PlannedTest dyno_steady_from_cold(const TestConditions& at) {
  return make_test("steady_from_cold", "80 km/h for an hour with vehicle and tires cold", 1,
                   {begin_cold(at).pull(kRoadLoad_N).roll(60.0, at.load_N)});
}

PlannedTest rollers_alone(const TestConditions& at) {
  return make_test("rollers_alone", "rollers alone for 30 min at 80 km/h, then the cold vehicle on them", 1,
                   {begin_cold(at).roll(30.0, 0.0).pull(kRoadLoad_N).roll(30.0, at.load_N)});
}

PlannedTest dyno_speed_steps_hot(const TestConditions& at) {
  return make_test("speed_steps_hot", "speed steps 80, 120, 40, 120 km/h, 10 min each, on warm tires", 0,
                   {begin_warm(at).pull(kRoadLoad_N).roll_at_speeds(10.0, at.load_N, {120.0, 40.0, 120.0})});
}

PlannedTest drive_and_brake(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (const double force_N : {kHard_N, 0.0, -kHard_N, 0.0}) run.pull(force_N).roll(5.0, at.load_N);
  return make_test("drive_and_brake",
                   "80 km/h against 1 kN of drive force, none, 1 kN of brake force, none, 5 min each, on warm tires", 0,
                   {run});
}

PlannedTest dyno_ramps(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (int i = 0; i < 6; ++i) run.roll_at_speeds(1.0, at.load_N, {120.0, 40.0});
  return make_test("ramps", "ramps between 40 and 120 km/h driven by the rollers, up and down, six times", 0, {run});
}

PlannedTest ballast(const TestConditions& at) {
  const auto run_at = [&](double load_N) { return begin_cold(at).pull(kRoadLoad_N).roll(30.0, load_N); };
  return make_test("ballast",
                   fmt::format("80 km/h from cold at two axle loads, {:.0f} and {:.0f} N a wheel, 30 min each",
                               0.8 * at.load_N, 1.2 * at.load_N),
                   2, {run_at(0.8 * at.load_N), run_at(1.2 * at.load_N)});
}

PlannedTest dyno_pressure_sweep(const TestConditions& at) {
  constexpr double kStep_Pa = 50e3;
  const double low_Pa = at.pressure_Pa - kStep_Pa;
  const double high_Pa = at.pressure_Pa + kStep_Pa;
  const RunPlan run = begin_cold(at).pull(kRoadLoad_N).roll(30.0, at.load_N);
  return make_test("pressure_sweep",
                   fmt::format("80 km/h from cold at {:.0f} and {:.0f} kPa, 30 min each", low_Pa / 1e3, high_Pa / 1e3),
                   2, {RunPlan(run).at_pressure(low_Pa), RunPlan(run).at_pressure(high_Pa)});
}

PlannedTest dyno_rests(const TestConditions& at) {
  RunPlan run = begin_cold(at).pull(kRoadLoad_N).roll(30.0, at.load_N).stand(10.0, at.load_N).roll(15.0, at.load_N);
  return make_test("rests", "drive at 80 km/h after a night, after 10 min and after 1 h at rest", 1,
                   {run.stand(60.0, at.load_N).roll(15.0, at.load_N)});
}

PlannedTest dyno_soak_with_pressure(const TestConditions& at) {
  return make_test("soak_with_pressure", "soak for 90 min after a drive, pressure and liner temperature logged", 0,
                   {begin_warm(at).stand(90.0, at.load_N)});
}

PlannedTest dyno_rim_thermocouple(const TestConditions& at) {
  return fit_rim_thermocouple(
      make_test("rim_thermocouple", "thermocouple on the rim: 20 min at 120 km/h, then 45 min at rest", 0,
                {begin_warm(read_rim_too(at)).roll(20.0, at.load_N, 120.0).stand(45.0, at.load_N)}));
}

PlannedTest dyno_warm_surface(const TestConditions& at) {
  constexpr double kWarmer_K = 15.0;  // Assumed: what a warmed-up roller reaches
  return make_test("warm_surface", "80 km/h with cold tires on rollers 15 K above the ambient, their surface recorded",
                   1, {begin_cold(at).on_surface(at.ambient_K + kWarmer_K).pull(kRoadLoad_N).roll(40.0, at.load_N)});
}

}  // namespace

std::vector<PlannedTest> make_dyno_tests(const PreparedSet& set) {
  TestConditions at = find_test_conditions(set);
  at.held = {{models::quantities::kLongitudinalForce, 0.0}};
  std::vector<PlannedTest> menu;
  for (const auto make :
       {dyno_steady_from_cold, rollers_alone, dyno_speed_steps_hot, drive_and_brake, dyno_ramps, ballast,
        dyno_pressure_sweep, dyno_rests, dyno_soak_with_pressure, dyno_rim_thermocouple, dyno_warm_surface}) {
    menu.push_back(make(at));
  }
  return menu;
}

}  // namespace rollrig::diagnosis
