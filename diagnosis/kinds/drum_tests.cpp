#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/checks/rig_sensors.h"
#include "diagnosis/kinds/kinds.h"
#include "diagnosis/kinds/test_plan.h"

namespace rollrig::diagnosis {
namespace {

const std::vector<double> kSkimLoads_N{50.0, 100.0, 200.0, 400.0};

bool records_surface(const PreparedSet& set) {
  return std::any_of(set.runs().begin(), set.runs().end(),
                     [](const PreparedRun& run) { return run.measured.has(models::quantities::kSurfaceTemperature); });
}

PlannedTest skim_at_loads(const TestConditions& at) {
  RunPlan run = begin_cold(at).roll_at_loads(3.0, kSkimLoads_N).roll(kWarmUp_min, at.load_N);
  return make_test("skim_at_loads",
                   fmt::format("skim at 50, 100, 200 and 400 N, extrapolated to zero, on the cold tire and again after "
                               "30 min at {:.0f} N and 80 km/h",
                               at.load_N),
                   1, {run.roll_at_loads(3.0, kSkimLoads_N)});
}

PlannedTest skim_at_loads_hot(const TestConditions& at) {
  return make_test("skim_at_loads_hot",
                   "skim at 50, 100, 200 and 400 N on the warm tire at 80 km/h, extrapolated to zero", 0,
                   {begin_warm(at).roll_at_loads(3.0, kSkimLoads_N)});
}

std::vector<double> list_sweep_loads(const TestConditions& at) {
  return {0.4 * at.load_N, 0.6 * at.load_N, 0.8 * at.load_N, at.load_N};
}

PlannedTest load_sweep(const TestConditions& at) {
  const std::vector<double> loads_N = list_sweep_loads(at);
  return make_test(
      "load_sweep",
      fmt::format("load sweep at 80 km/h, 40 to 100 % of {:.0f} N, on the cold tire and again on the hot one",
                  at.load_N),
      1, {begin_cold(at).roll_at_loads(5.0, loads_N).roll(20.0, at.load_N).roll_at_loads(5.0, loads_N)});
}

PlannedTest load_sweep_hot(const TestConditions& at) {
  const std::vector<double> loads_N = list_sweep_loads(at);
  return make_test(
      "load_sweep_hot",
      fmt::format("load sweep at 80 km/h on the warm tire, 40 to 100 % of {:.0f} N, up and down, 5 min each",
                  at.load_N),
      0, {begin_warm(at).roll_at_loads(5.0, loads_N).roll_at_loads(5.0, {loads_N.rbegin(), loads_N.rend()})});
}

PlannedTest drum_alone(const TestConditions& at) {
  return make_test(
      "drum_alone",
      fmt::format("drum alone for 30 min at 80 km/h, then a cold tire at {:.0f} N on the hot drum", at.load_N), 1,
      {begin_cold(at).roll(30.0, 0.0).roll(30.0, at.load_N)});
}

PlannedTest standstill_torque(const TestConditions& at) {
  PlannedTest test =
      make_test("standstill_torque", "torque at standstill, tire lifted, for 5 min before and after 40 min at 80 km/h",
                0, {RunPlan(at, 0.0).stand(5.0, 0.0).roll(40.0, 0.0, kUsual_km_h, false).stand(5.0, 0.0)});
  test.extra.force_at_standstill = true;
  test.by_hand = {"Lift the tire off, log the torque while the drum stands, before and after."};
  return test;
}

PlannedTest load_off_and_on(const TestConditions& at) {
  RunPlan run = begin_warm(at);
  for (int i = 0; i < 4; ++i) run.roll_at_loads(5.0, {at.skim_N, at.load_N});
  return make_test("load_off_and_on",
                   "load off and on, four times 5 min each, on the warm tire, its liner held near one temperature", 0,
                   {run});
}

PlannedTest rests(const TestConditions& at) {
  RunPlan run = begin_cold(at).roll(30.0, at.load_N).stand(10.0, at.load_N).roll(15.0, at.load_N);
  return make_test("rests", "roll at 80 km/h after a night, after 10 min and after 1 h at rest under load", 1,
                   {run.stand(60.0, at.load_N).roll(15.0, at.load_N)});
}

PlannedTest speed_steps_hot(const TestConditions& at) {
  return make_test("speed_steps_hot", "speed steps 80, 120, 40, 120 km/h, 10 min each, on the warm tire", 0,
                   {begin_warm(at).roll_at_speeds(10.0, at.load_N, {120.0, 40.0, 120.0})});
}

PlannedTest speed_steps_with_pulse(const TestConditions& at) {
  constexpr double kWiring_h = 0.25;  // Assumed
  PlannedTest test = make_test("speed_steps_with_pulse",
                               "speed steps 80, 120, 40, 120 km/h with a common electrical pulse on both loggers", 0,
                               {begin_warm(at).roll_at_speeds(10.0, at.load_N, {120.0, 40.0, 120.0})});
  test.hours += kWiring_h;
  test.clock_pulse = true;
  test.by_hand = {"Wire one electrical pulse to an input of both loggers and give it once at the start of the run."};
  return test;
}

RunPlan heat_and_soak(const TestConditions& at) { return begin_warm(at).roll(20.0, at.load_N, 120.0).stand(45.0, 0.0); }

PlannedTest short_soak(const TestConditions& at) {
  return make_test("short_soak",
                   "20 min at 120 km/h, then a soak of 45 min, lifted, pressure and liner temperature logged", 0,
                   {heat_and_soak(at)});
}

PlannedTest rim_thermocouple(const TestConditions& at) {
  return fit_rim_thermocouple(
      make_test("rim_thermocouple", "thermocouple on the rim: 20 min at 120 km/h, then 45 min at standstill, lifted", 0,
                {heat_and_soak(read_rim_too(at))}));
}

PlannedTest soak_with_pressure(const TestConditions& at) {
  return make_test("soak_with_pressure", "soak for 150 min after a run, pressure and liner temperature logged", 0,
                   {begin_warm(at).stand(150.0, 0.0)});
}

PlannedTest speed_steps(const TestConditions& at) {
  return make_test("speed_steps", fmt::format("80, 120 and 40 km/h, 20 min each, at {:.0f} N from cold", at.load_N), 1,
                   {begin_cold(at).roll_at_speeds(20.0, at.load_N, {80.0, 120.0, 40.0})});
}

PlannedTest pressure_sweep(const TestConditions& at) {
  constexpr double kStep_Pa = 60e3;
  const auto run_at = [&](double pressure_Pa) { return begin_cold(at).at_pressure(pressure_Pa).roll(30.0, at.load_N); };
  const double low_Pa = at.pressure_Pa - kStep_Pa;
  const double high_Pa = at.pressure_Pa + kStep_Pa;
  return make_test(
      "pressure_sweep",
      fmt::format("pressure sweep at 80 km/h and {:.0f} N: {:.0f}, {:.0f} and {:.0f} kPa, 30 min each from cold",
                  at.load_N, low_Pa / 1e3, at.pressure_Pa / 1e3, high_Pa / 1e3),
      3, {run_at(low_Pa), run_at(at.pressure_Pa), run_at(high_Pa)});
}

PlannedTest fast_steps(const TestConditions& at) {
  return make_test("fast_steps", "fine speed steps from 100 to 140 km/h, 6 min each, on the warm tire", 0,
                   {begin_warm(at).roll_at_speeds(6.0, at.load_N, {100.0, 110.0, 120.0, 130.0, 140.0})});
}

PlannedTest warm_surface(const TestConditions& at) {
  constexpr double kWarmer_K = 15.0;  // Assumed: what heaters over a steel drum reach
  PlannedTest test =
      make_test("warm_surface", "80 km/h from cold on a drum surface heated to 15 K above the ambient and recorded", 1,
                {begin_cold(at).on_surface(at.ambient_K + kWarmer_K).roll(40.0, at.load_N)});
  test.by_hand = {"Heat the drum's surface to 15 K above the air, hold it there and record its temperature."};
  return test;
}

PlannedTest reversed_rotation(const TestConditions& at) {
  const RunPlan forwards = begin_warm(at).roll_at_loads(5.0, {at.skim_N, 0.5 * at.load_N, at.skim_N, at.load_N});
  PlannedTest test =
      make_test("reversed_rotation", "the same load steps forwards and in reversed rotation, 80 km/h, on the warm tire",
                0, {forwards, RunPlan(forwards).reversed()});
  test.by_hand = {"Turn the drum the other way round in the second run; its torque counts positive when it drives."};
  return test;
}

PlannedTest dead_weights(const TestConditions& at) {
  constexpr double kWeights_h = 0.25;             // Assumed: lever mounted, weights hung
  constexpr double kHung[] = {50.0, 100.0, 0.0};  // N m, N. Assumed: about once and twice what a test needs
  RunPlan run(at, 0.0);
  run.stand(3.0, 0.0);
  for (const double torque_or_force : kHung) run.hang(torque_or_force).stand(3.0, 0.0);
  const bool is_torque = at.hung == models::quantities::kHungTorque;
  PlannedTest test =
      make_test("dead_weights",
                is_torque ? "weights on a lever: 50 and 100 N m on the torque sensor at standstill, tire lifted"
                          : "weights that pull the belt with 50 and 100 N at standstill, tire lifted",
                0, {run});
  test.hours += kWeights_h;
  test.extra.force_at_standstill = true;
  test.by_hand = {
      is_torque ? "Hang 0, 50, 100 and 0 N m on the drum with a lever of known length, 3 min each, and log the torque."
                : "Pull the belt with weights of 0, 50, 100 and 0 N, 3 min each, and log the force."};
  return test;
}

PlannedTest bare_drum_steps(const TestConditions& at) {
  const std::vector<double> speeds_km_h{40.0, 80.0, 120.0};
  return make_test("bare_drum_steps",
                   "speed steps 40, 80, 120 km/h of the drum alone, then with the tire in skim, 4 min each, all warm",
                   0,
                   {begin_warm(at).roll_at_speeds(4.0, 0.0, speeds_km_h).roll_at_speeds(4.0, at.skim_N, speeds_km_h)});
}

PlannedTest ramps(const TestConditions& at) {
  RunPlan run = RunPlan(at, 40.0).roll(15.0, 0.0, 40.0, false);
  for (int i = 0; i < 4; ++i) run.roll_at_speeds(1.0, 0.0, {120.0, 40.0});
  return make_test("ramps", "ramps of 1 km/h a second between 40 and 120 km/h, tire lifted, up and down four times", 0,
                   {run});
}

PlannedTest standstill_at_loads(const TestConditions& at) {
  const std::vector<double> loads_N{0.0, 0.5 * at.load_N, at.load_N};
  PlannedTest test =
      make_test("standstill_at_loads",
                fmt::format("torque and pressure at standstill at 0, {:.0f} and {:.0f} N, 3 min each, twice",
                            0.5 * at.load_N, at.load_N),
                0, {RunPlan(at, 0.0).roll_at_loads(3.0, loads_N, 0.0).roll_at_loads(3.0, loads_N, 0.0)});
  test.extra.force_at_standstill = true;
  test.by_hand = {"Log the torque while the drum stands, its motor holding it."};
  return test;
}

}  // namespace

std::vector<PlannedTest> make_drum_tests(const PreparedSet& set) {
  const TestConditions at = find_test_conditions(set);
  return {skim_at_loads(at),
          skim_at_loads_hot(at),
          load_sweep(at),
          load_sweep_hot(at),
          drum_alone(at),
          standstill_torque(at),
          load_off_and_on(at),
          rests(at),
          speed_steps_hot(at),
          speed_steps_with_pulse(at),
          short_soak(at),
          rim_thermocouple(at),
          soak_with_pressure(at),
          speed_steps(at),
          pressure_sweep(at),
          fast_steps(at),
          warm_surface(at),
          reversed_rotation(at),
          dead_weights(at),
          bare_drum_steps(at),
          ramps(at),
          standstill_at_loads(at)};
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
  RunPlan run = begin_cold(at).roll(kWarmUp_min, at.load_N).roll(3.0, at.skim_N);
  PlannedTest test = make_test("ordinary_run",
                               "30 min at 80 km/h from cold, 3 min of skim, 15 min at 120 km/h, 15 min at rest, lifted",
                               1, {run.roll(15.0, at.load_N, 120.0).stand(15.0, 0.0)});
  test.extra.sensors = sensors;
  return test;
}

}  // namespace rollrig::diagnosis
