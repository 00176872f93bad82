#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/test_plan.h"

namespace rollrig::diagnosis {
namespace {

bool records_surface(const PreparedSet& set) {
  return std::any_of(set.runs().begin(), set.runs().end(),
                     [](const PreparedRun& run) { return run.measured.has(models::quantities::kSurfaceTemperature); });
}

PlannedTest skim_at_loads(const TestConditions& at) {
  const double loads_N[] = {50.0, 100.0, 200.0, 400.0};
  RunPlan run = begin_cold(at);
  for (const double load_N : loads_N) run.roll(3.0, load_N, kUsual_km_h);
  run.roll(kWarmUp_min, at.load_N, kUsual_km_h);
  for (const double load_N : loads_N) run.roll(3.0, load_N, kUsual_km_h);
  return make_test("skim_at_loads",
                   fmt::format("skim at 50, 100, 200 and 400 N, extrapolated to zero, on the cold tire and again after "
                               "30 min at {:.0f} N and 80 km/h",
                               at.load_N),
                   1, {run.finish()});
}

PlannedTest skim_at_loads_hot(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (const double load_N : {50.0, 100.0, 200.0, 400.0}) run.roll(3.0, load_N, kUsual_km_h);
  return make_test("skim_at_loads_hot",
                   "skim at 50, 100, 200 and 400 N on the warm tire at 80 km/h, extrapolated to zero", 0,
                   {run.finish()});
}

PlannedTest load_sweep(const TestConditions& at) {
  const double shares[] = {0.4, 0.6, 0.8, 1.0};
  RunPlan run = begin_cold(at);
  for (const double share : shares) run.roll(5.0, share * at.load_N, kUsual_km_h);
  run.roll(20.0, at.load_N, kUsual_km_h);
  for (const double share : shares) run.roll(5.0, share * at.load_N, kUsual_km_h);
  return make_test(
      "load_sweep",
      fmt::format("load sweep at 80 km/h, 40 to 100 % of {:.0f} N, on the cold tire and again on the hot one",
                  at.load_N),
      1, {run.finish()});
}

PlannedTest drum_alone(const TestConditions& at) {
  RunPlan run = begin_cold(at);
  run.roll(30.0, 0.0, kUsual_km_h).roll(30.0, at.load_N, kUsual_km_h);
  return make_test(
      "drum_alone",
      fmt::format("drum alone for 30 min at 80 km/h, then a cold tire at {:.0f} N on the hot drum", at.load_N), 1,
      {run.finish()});
}

PlannedTest standstill_torque(const TestConditions& at) {
  RunPlan run(at, 0.0);
  run.stand(5.0, 0.0).roll(40.0, 0.0, kUsual_km_h, false).stand(5.0, 0.0);
  PlannedTest test =
      make_test("standstill_torque", "torque at standstill, tire lifted, for 5 min before and after 40 min at 80 km/h",
                0, {run.finish()});
  test.extra.force_at_standstill = true;
  test.by_hand = {"Lift the tire off, log the torque while the drum stands, before and after."};
  return test;
}

PlannedTest load_off_and_on(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (int i = 0; i < 4; ++i) run.roll(5.0, at.skim_N, kUsual_km_h).roll(5.0, at.load_N, kUsual_km_h);
  return make_test("load_off_and_on",
                   "load off and on, four times 5 min each, on the warm tire, its liner held near one temperature", 0,
                   {run.finish()});
}

PlannedTest rests(const TestConditions& at) {
  RunPlan run = begin_cold(at);
  run.roll(30.0, at.load_N, kUsual_km_h).stand(10.0, at.load_N).roll(15.0, at.load_N, kUsual_km_h);
  run.stand(60.0, at.load_N).roll(15.0, at.load_N, kUsual_km_h);
  return make_test("rests", "roll at 80 km/h after a night, after 10 min and after 1 h at rest under load", 1,
                   {run.finish()});
}

PlannedTest speed_steps_hot(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  run.roll(10.0, at.load_N, 120.0).roll(10.0, at.load_N, 40.0).roll(10.0, at.load_N, 120.0);
  return make_test("speed_steps_hot", "speed steps 80, 120, 40, 120 km/h, 10 min each, on the warm tire", 0,
                   {run.finish()});
}

PlannedTest speed_steps_with_pulse(const TestConditions& at) {
  constexpr double kWiring_h = 0.25;  // Assumed
  PlannedTest test = make_test("speed_steps_with_pulse",
                               "speed steps 80, 120, 40, 120 km/h with a common electrical pulse on both loggers", 0,
                               speed_steps_hot(at).runs);
  test.hours += kWiring_h;
  test.clock_pulse = true;
  test.by_hand = {"Wire one electrical pulse to an input of both loggers and give it once at the start of the run."};
  return test;
}

PlannedTest short_soak(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  run.roll(20.0, at.load_N, 120.0).stand(45.0, 0.0);
  return make_test("short_soak",
                   "20 min at 120 km/h, then a soak of 45 min, lifted, pressure and liner temperature logged", 0,
                   {run.finish()});
}

PlannedTest rim_thermocouple(const TestConditions& at) {
  const TestConditions with_rim = read_rim_too(at);
  return fit_rim_thermocouple(
      make_test("rim_thermocouple", "thermocouple on the rim: 20 min at 120 km/h, then 45 min at standstill, lifted", 0,
                short_soak(with_rim).runs));
}

PlannedTest soak_with_pressure(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  run.stand(150.0, 0.0);
  return make_test("soak_with_pressure", "soak for 150 min after a run, pressure and liner temperature logged", 0,
                   {run.finish()});
}

PlannedTest speed_steps(const TestConditions& at) {
  RunPlan run = begin_cold(at);
  for (const double speed_km_h : {80.0, 120.0, 40.0}) run.roll(20.0, at.load_N, speed_km_h);
  return make_test("speed_steps", fmt::format("80, 120 and 40 km/h, 20 min each, at {:.0f} N from cold", at.load_N), 1,
                   {run.finish()});
}

PlannedTest pressure_sweep(const TestConditions& at) {
  constexpr double kStep_Pa = 60e3;
  std::vector<measurements::MeasuredRun> runs;
  for (const double step : {-1.0, 0.0, 1.0}) {
    RunPlan run = begin_cold(at);
    runs.push_back(run.at_pressure(at.pressure_Pa + step * kStep_Pa).roll(30.0, at.load_N, kUsual_km_h).finish());
  }
  return make_test(
      "pressure_sweep",
      fmt::format("pressure sweep at 80 km/h and {:.0f} N: {:.0f}, {:.0f} and {:.0f} kPa, 30 min each from cold",
                  at.load_N, (at.pressure_Pa - kStep_Pa) / 1e3, at.pressure_Pa / 1e3,
                  (at.pressure_Pa + kStep_Pa) / 1e3),
      3, std::move(runs));
}

PlannedTest fast_steps(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (const double speed_km_h : {100.0, 110.0, 120.0, 130.0, 140.0}) run.roll(6.0, at.load_N, speed_km_h);
  return make_test("fast_steps", "fine speed steps from 100 to 140 km/h, 6 min each, on the warm tire", 0,
                   {run.finish()});
}

PlannedTest warm_surface(const TestConditions& at) {
  constexpr double kWarmer_K = 15.0;  // Assumed: what heaters over a steel drum reach
  RunPlan run = begin_cold(at);
  run.on_surface(at.ambient_K + kWarmer_K).roll(40.0, at.load_N, kUsual_km_h);
  PlannedTest test =
      make_test("warm_surface", "80 km/h from cold on a drum surface heated to 15 K above the ambient and recorded", 1,
                {run.finish()});
  test.by_hand = {"Heat the drum's surface to 15 K above the air, hold it there and record its temperature."};
  return test;
}

PlannedTest reversed_rotation(const TestConditions& at) {
  const auto steps = [&](bool is_reversed) {
    RunPlan run = begin_warm(at);
    if (is_reversed) run.reversed();
    for (const double share : {0.5, 1.0}) {
      run.roll(5.0, at.skim_N, kUsual_km_h).roll(5.0, share * at.load_N, kUsual_km_h);
    }
    return run.finish();
  };
  PlannedTest test =
      make_test("reversed_rotation", "the same load steps forwards and in reversed rotation, 80 km/h, on the warm tire",
                0, {steps(false), steps(true)});
  test.by_hand = {"Turn the drum the other way round in the second run; its torque counts positive when it drives."};
  return test;
}

PlannedTest dead_weights(const TestConditions& at) {
  constexpr double kWeights_h = 0.25;                // Assumed: lever mounted, weights hung
  constexpr double kHung_Nm[] = {50.0, 100.0, 0.0};  // Assumed: about once and twice the torque of a test
  RunPlan run(at, 0.0);
  run.stand(3.0, 0.0);
  for (const double torque_Nm : kHung_Nm) run.hang(torque_Nm).stand(3.0, 0.0);
  PlannedTest test =
      make_test("dead_weights", "weights on a lever: 50 and 100 N m on the torque sensor at standstill, tire lifted", 0,
                {run.finish()});
  test.hours += kWeights_h;
  test.extra.force_at_standstill = true;
  test.by_hand = {
      "Hang 0, 50, 100 and 0 N m on the drum with a lever of known length, 3 min each, and log the torque."};
  return test;
}

PlannedTest bare_drum_steps(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (const double load_N : {0.0, at.skim_N}) {
    for (const double speed_km_h : {40.0, 80.0, 120.0}) run.roll(4.0, load_N, speed_km_h);
  }
  return make_test("bare_drum_steps",
                   "speed steps 40, 80, 120 km/h of the drum alone, then with the tire in skim, 4 min each, all warm",
                   0, {run.finish()});
}

PlannedTest ramps(const TestConditions& at) {
  RunPlan run(at, 40.0);
  run.roll(15.0, 0.0, 40.0, false);
  for (int i = 0; i < 4; ++i) run.roll(1.0, 0.0, 120.0).roll(1.0, 0.0, 40.0);
  return make_test("ramps", "ramps of 1 km/h a second between 40 and 120 km/h, tire lifted, up and down four times", 0,
                   {run.finish()});
}

PlannedTest standstill_at_loads(const TestConditions& at) {
  RunPlan run(at, 0.0);
  for (int i = 0; i < 2; ++i) {
    for (const double share : {0.0, 0.5, 1.0}) run.stand(3.0, share * at.load_N);
  }
  PlannedTest test =
      make_test("standstill_at_loads",
                fmt::format("torque and pressure at standstill at 0, {:.0f} and {:.0f} N, 3 min each, twice",
                            0.5 * at.load_N, at.load_N),
                0, {run.finish()});
  test.extra.force_at_standstill = true;
  test.by_hand = {"Log the torque while the drum stands, its motor holding it."};
  return test;
}

}  // namespace

std::vector<PlannedTest> make_drum_tests(const PreparedSet& set) {
  const TestConditions at = find_test_conditions(set);
  std::vector<PlannedTest> menu;
  for (const auto make : {skim_at_loads,
                          skim_at_loads_hot,
                          load_sweep,
                          drum_alone,
                          standstill_torque,
                          load_off_and_on,
                          rests,
                          speed_steps_hot,
                          speed_steps_with_pulse,
                          short_soak,
                          rim_thermocouple,
                          soak_with_pressure,
                          speed_steps,
                          pressure_sweep,
                          fast_steps,
                          warm_surface,
                          reversed_rotation,
                          dead_weights,
                          bare_drum_steps,
                          ramps,
                          standstill_at_loads}) {
    menu.push_back(make(at));
  }
  return menu;
}

PlannedTest make_drum_sensor_test(const PreparedSet& set) {
  TestConditions at = find_test_conditions(set);
  std::vector<Quantity> sensors;
  for (const RigSensor& sensor : all_rig_sensors()) {
    const bool is_there = std::find(at.channels.begin(), at.channels.end(), sensor.channel) != at.channels.end();
    const bool is_recorded = sensor.channel == kSurfaceReading && records_surface(set);
    if (!is_there && !is_recorded) sensors.push_back(sensor.channel);
  }
  at.channels.insert(at.channels.end(), sensors.begin(), sensors.end());
  RunPlan run = begin_cold(at);
  run.roll(kWarmUp_min, at.load_N, kUsual_km_h).roll(3.0, at.skim_N, kUsual_km_h);
  run.roll(15.0, at.load_N, 120.0).stand(15.0, 0.0);
  PlannedTest test = make_test("ordinary_run",
                               "30 min at 80 km/h from cold, 3 min of skim, 15 min at 120 km/h, 15 min at rest, lifted",
                               1, {run.finish()});
  test.extra.sensors = sensors;
  return test;
}

}  // namespace rollrig::diagnosis
