#include <fmt/format.h>

#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/test_plan.h"
#include "models/parasitic_loss.h"

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

PlannedTest standstill_force(const TestConditions& at) {
  RunPlan run(at, 0.0);
  const auto read_zero = [&] {
    for (int i = 0; i < 2; ++i) run.stand(5.0, 0.0).stand(5.0, at.load_N);
  };
  read_zero();
  run.roll(40.0, at.load_N, kUsual_km_h, false);
  read_zero();
  PlannedTest test = make_test("standstill_force",
                               fmt::format("loss force at standstill, lifted and at {:.0f} N, twice 5 min each, before "
                                           "and after 40 min at 80 km/h",
                                           at.load_N),
                               0, {run});
  test.extra.force_at_standstill = true;
  test.by_hand = {"Log the force while the rollers stand free, the vehicle lifted off and on them, before and after."};
  return test;
}

PlannedTest dyno_dead_weights(const TestConditions& at) {
  constexpr double kWeights_h = 0.25;                // Assumed: lever mounted, weights hung
  constexpr double kHung_N[] = {200.0, 500.0, 0.0};  // Assumed: some times the loss of a wheel
  RunPlan run(at, 0.0);
  run.stand(3.0, 0.0);
  for (const double force_N : kHung_N) run.hang(force_N).stand(3.0, 0.0);
  PlannedTest test = make_test("dead_weights",
                               "weights on a lever: 200 and 500 N at the surface of the roller on its load cell, at "
                               "standstill, nothing on the roller",
                               0, {run});
  test.hours += kWeights_h;
  test.extra.force_at_standstill = true;
  test.by_hand = {
      "Hang 0, 200, 500 and 0 N, reckoned at the roller's surface, on the roller with a lever of known length, 3 min "
      "each, and log the force."};
  return test;
}

PlannedTest wheel_scale(const TestConditions& at) {
  constexpr double kScale_h = 0.5;  // Assumed: scale under the wheel or cells under the roller, ballast twice
  const std::vector<double> loads_N{0.8 * at.load_N, at.load_N, 1.2 * at.load_N};
  RunPlan run(read_too(at, models::quantities::kContactLoad), 0.0);
  PlannedTest test = make_test("wheel_scale",
                               fmt::format("load under the wheel on a scale, tied down, at {:.0f}, {:.0f} and {:.0f} N "
                                           "as reported, 5 min each",
                                           loads_N[0], loads_N[1], loads_N[2]),
                               0, {run.roll_at_loads(5.0, loads_N, 0.0)});
  test.hours += kScale_h;
  test.extra.sensors = {models::quantities::kContactLoad};
  test.by_hand = {"Put a scale under the tied-down wheel, or read cells under the roller, and log its load."};
  return test;
}

PlannedTest light_barrier(const TestConditions& at) {
  constexpr double kBarrier_h = 0.25;  // Assumed: barrier and marks fitted
  RunPlan run(read_too(at, models::quantities::kSpeedReading), 40.0);
  PlannedTest test =
      make_test("light_barrier", "turns of the roller counted by a light barrier at 40, 80 and 120 km/h, 4 min each", 0,
                {run.roll_at_speeds(4.0, 0.0, {40.0, 80.0, 120.0})});
  test.hours += kBarrier_h;
  test.extra.sensors = {models::quantities::kSpeedReading};
  test.by_hand = {"Count the turns of the roller by a light barrier; their rate times its circumference is the speed."};
  return test;
}

PlannedTest dyno_reversed(const TestConditions& at) {
  constexpr double kTurned_h = 0.5;  // Assumed: vehicle released, turned round and tied down again
  const RunPlan forwards = begin_warm(at).pull(0.0).roll_at_speeds(5.0, at.load_N, {80.0, 120.0, 40.0});
  PlannedTest test = make_test("reversed_rotation",
                               "the same speed steps forwards and with the vehicle turned round, 80, 120 and 40 km/h, "
                               "5 min each, driven by the rollers, on warm tires",
                               0, {forwards, RunPlan(forwards).reversed()});
  test.hours += kTurned_h;
  test.by_hand = {"Turn the vehicle round for the second run, so that the roller turns the other way."};
  return test;
}

constexpr int kCoasts = 3;

PlannedTest lifted_coastdown(const PreparedSet& set, const TestConditions& at) {
  const models::ParasiticParameters<double>& bearings = set.context().parasitic;
  const auto calc_slowing_m_s2 = [&](double speed_m_s) {
    return models::calc_parasitic_N(bearings, speed_m_s) / set.context().machine_mass_kg;
  };
  RunPlan run = RunPlan(at, kUsual_km_h).roll(15.0, 0.0, kUsual_km_h, false);
  for (int i = 0; i < kCoasts; ++i) run.roll(1.0, 0.0, 120.0).coast(0.0, 20.0, calc_slowing_m_s2);
  PlannedTest test =
      make_test("lifted_coastdown", "rollers alone coast from 120 to 20 km/h, three times, warm", 0, {run});
  test.by_hand = {"Let the rollers coast without drive, the vehicle lifted off; log loss and speed."};
  return test;
}

PlannedTest loaded_coastdown(const PreparedSet& set, const TestConditions& at) {
  constexpr double kRolling = 0.01;  // Assumed: near enough for how fast the speed falls, which the run records
  const models::ParasiticParameters<double>& bearings = set.context().parasitic;
  const auto calc_slowing_m_s2 = [&](double speed_m_s) {
    return (kRolling * at.load_N + models::calc_parasitic_N(bearings, speed_m_s)) / set.context().machine_mass_kg;
  };
  RunPlan run = begin_warm(at).pull(0.0);
  for (int i = 0; i < 2 * kCoasts; ++i) run.roll(1.0, at.load_N, 120.0).coast(at.load_N, 20.0, calc_slowing_m_s2);
  PlannedTest test = make_test(
      "loaded_coastdown", "vehicle in neutral on its rollers coasts from 120 to 20 km/h, six times, warm", 0, {run});
  test.by_hand = {"Shift to neutral and let the rollers coast without drive; log loss and speed."};
  return test;
}

}  // namespace

std::vector<PlannedTest> make_dyno_tests(const PreparedSet& set) {
  TestConditions at = find_test_conditions(set);
  at.held = {{models::quantities::kLongitudinalForce, 0.0}};
  std::vector<PlannedTest> menu;
  for (const auto make :
       {dyno_steady_from_cold, rollers_alone, dyno_speed_steps_hot, drive_and_brake, dyno_ramps, ballast,
        dyno_pressure_sweep, dyno_rests, dyno_soak_with_pressure, dyno_rim_thermocouple, dyno_warm_surface,
        standstill_force, dyno_dead_weights, wheel_scale, light_barrier, dyno_reversed}) {
    menu.push_back(make(at));
  }
  menu.push_back(lifted_coastdown(set, at));
  menu.push_back(loaded_coastdown(set, at));
  return menu;
}

}  // namespace rollrig::diagnosis
