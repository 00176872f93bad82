#include "diagnosis/test_menu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollrig::diagnosis {
namespace {

constexpr double kSetUp_h = 0.5;
constexpr double kSoak_h = 3.0;
constexpr double kUsual_km_h = 80.0;  // ISO 28580
constexpr double kAcceleration_km_h_s = 1.0;

/// What does not change from test to test.
struct Conditions {
  double load_N = 0.0;
  double skim_N = 0.0;
  double pressure_Pa = 0.0;
  double ambient_K = 0.0;
  std::vector<std::string> channels;
};

/// The set's highest load, on which the tire is known to run, and its middle pressure.
Conditions find_conditions(const PreparedSet& set) {
  std::vector<double> pressures_Pa;
  for (const PreparedRun& run : set.runs()) pressures_Pa.push_back(run.measured.cold_pressure_Pa);
  std::nth_element(pressures_Pa.begin(), pressures_Pa.begin() + static_cast<std::ptrdiff_t>(pressures_Pa.size() / 2),
                   pressures_Pa.end());
  double load_N = 0.0;
  for (const PreparedRun& run : set.runs()) {
    const std::vector<double>& loads_N = run.measured.columns.at("load_N");
    load_N = std::max(load_N, *std::max_element(loads_N.begin(), loads_N.end()));
  }
  const rigs::RigFile& rig = *set.source().rig;
  return {load_N, rig.skim.load_N, pressures_Pa[pressures_Pa.size() / 2], rig.environment.ambient_K, set.channels()};
}

/// Writes a run stage by stage, from soaked at the ambient.
class RunPlan {
 public:
  RunPlan(const Conditions& conditions, double first_km_h) : conditions_(conditions), speed_km_h_(first_km_h) {
    run_.initial_tire_temperature_K = conditions.ambient_K;
    run_.cold_pressure_Pa = conditions.pressure_Pa;
  }

  /// Goes to a speed at once with the new load, then holds both.
  RunPlan& roll(double minutes, double load_N, double speed_km_h, bool read = true) {
    load_N_ = load_N;
    read_ = read;
    const double change_km_h = speed_km_h - speed_km_h_;
    const double start_km_h = speed_km_h_;
    const auto ramp = static_cast<int>(std::ceil(std::abs(change_km_h) / kAcceleration_km_h_s / kVirtualRow_s - 1e-9));
    for (int i = 0; i < ramp; ++i) add_row(start_km_h + change_km_h * i / ramp);
    const auto steady = static_cast<int>(std::lround(60.0 * minutes / kVirtualRow_s));
    for (int i = 0; i < steady; ++i) add_row(speed_km_h);
    speed_km_h_ = speed_km_h;
    return *this;
  }
  RunPlan& stand(double minutes, double load_N, bool read = true) { return roll(minutes, load_N, 0.0, read); }
  RunPlan& at_pressure(double pressure_Pa) {
    run_.cold_pressure_Pa = pressure_Pa;
    return *this;
  }
  RunPlan& on_surface(double surface_K) {
    surface_K_ = surface_K;
    return *this;
  }

  scenarios::MeasuredRun finish() {
    add_row(speed_km_h_);
    return run_;
  }

 private:
  void add_row(double speed_km_h) {
    const bool first = run_.time_s.empty();
    run_.time_s.push_back(first ? 0.0 : run_.time_s.back() + kVirtualRow_s);
    run_.columns["speed_km_h"].push_back(speed_km_h / 3.6);
    run_.columns["load_N"].push_back(load_N_);
    run_.columns["ambient_degC"].push_back(conditions_.ambient_K);
    if (surface_K_ > 0.0) run_.columns["surface_temperature_degC"].push_back(surface_K_);
    for (const std::string& channel : conditions_.channels) {
      run_.columns[channel].push_back(read_ ? 0.0 : std::numeric_limits<double>::quiet_NaN());
    }
  }

  Conditions conditions_;
  scenarios::MeasuredRun run_;
  double speed_km_h_;
  double load_N_ = 0.0;
  double surface_K_ = 0.0;  // 0: not recorded
  bool read_ = true;
};

constexpr double kWarmUp_min = 30.0;  // the source's warm-up

/// A run on a warm tire.
RunPlan begin_warm(const Conditions& at) {
  return RunPlan(at, kUsual_km_h).roll(kWarmUp_min, at.load_N, kUsual_km_h, false);
}
RunPlan begin_cold(const Conditions& at) { return {at, kUsual_km_h}; }

PlannedTest make_test(const char* id, std::string description, int soaks, std::vector<scenarios::MeasuredRun> runs) {
  PlannedTest test{id, std::move(description), kSetUp_h + soaks * kSoak_h, std::move(runs), {}, false};
  for (std::size_t i = 0; i < test.runs.size(); ++i) {
    test.runs[i].id = fmt::format("{}-{}", id, i + 1);
    test.runs[i].session = "next";
    test.hours += test.runs[i].time_s.back() / 3600.0;
  }
  return test;
}

PlannedTest skim_at_loads(const Conditions& at) {
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

PlannedTest skim_at_loads_hot(const Conditions& at) {
  RunPlan run = begin_warm(at);
  for (const double load_N : {50.0, 100.0, 200.0, 400.0}) run.roll(3.0, load_N, kUsual_km_h);
  return make_test("skim_at_loads_hot",
                   "skim at 50, 100, 200 and 400 N on the warm tire at 80 km/h, extrapolated to zero", 0,
                   {run.finish()});
}

PlannedTest load_sweep(const Conditions& at) {
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

PlannedTest drum_alone(const Conditions& at) {
  RunPlan run = begin_cold(at);
  run.roll(30.0, 0.0, kUsual_km_h).roll(30.0, at.load_N, kUsual_km_h);
  return make_test(
      "drum_alone",
      fmt::format("drum alone for 30 min at 80 km/h, then a cold tire at {:.0f} N on the hot drum", at.load_N), 1,
      {run.finish()});
}

PlannedTest standstill_torque(const Conditions& at) {
  RunPlan run(at, 0.0);
  run.stand(5.0, 0.0).roll(40.0, 0.0, kUsual_km_h, false).stand(5.0, 0.0);
  PlannedTest test =
      make_test("standstill_torque", "torque at standstill, tire lifted, for 5 min before and after 40 min at 80 km/h",
                0, {run.finish()});
  test.extra.torque_at_standstill = true;
  return test;
}

PlannedTest load_off_and_on(const Conditions& at) {
  RunPlan run = begin_warm(at);
  for (int i = 0; i < 4; ++i) run.roll(5.0, at.skim_N, kUsual_km_h).roll(5.0, at.load_N, kUsual_km_h);
  return make_test("load_off_and_on",
                   "load off and on, four times 5 min each, on the warm tire, its liner held near one temperature", 0,
                   {run.finish()});
}

PlannedTest rests(const Conditions& at) {
  RunPlan run = begin_cold(at);
  run.roll(30.0, at.load_N, kUsual_km_h).stand(10.0, at.load_N).roll(15.0, at.load_N, kUsual_km_h);
  run.stand(60.0, at.load_N).roll(15.0, at.load_N, kUsual_km_h);
  return make_test("rests", "roll at 80 km/h after a night, after 10 min and after 1 h at rest under load", 1,
                   {run.finish()});
}

PlannedTest speed_steps_hot(const Conditions& at) {
  RunPlan run = begin_warm(at);
  run.roll(10.0, at.load_N, 120.0).roll(10.0, at.load_N, 40.0).roll(10.0, at.load_N, 120.0);
  return make_test("speed_steps_hot", "speed steps 80, 120, 40, 120 km/h, 10 min each, on the warm tire", 0,
                   {run.finish()});
}

PlannedTest speed_steps_with_pulse(const Conditions& at) {
  constexpr double kWiring_h = 0.25;  // Assumed
  PlannedTest test = make_test("speed_steps_with_pulse",
                               "speed steps 80, 120, 40, 120 km/h with a common electrical pulse on both loggers", 0,
                               speed_steps_hot(at).runs);
  test.hours += kWiring_h;
  test.clock_pulse = true;
  return test;
}

PlannedTest short_soak(const Conditions& at) {
  RunPlan run = begin_warm(at);
  run.roll(20.0, at.load_N, 120.0).stand(45.0, 0.0);
  return make_test("short_soak",
                   "20 min at 120 km/h, then a soak of 45 min, lifted, pressure and liner temperature logged", 0,
                   {run.finish()});
}

PlannedTest rim_thermocouple(const Conditions& at) {
  constexpr double kFitting_h = 1.0;  // Assumed: sensor and its slip ring or logger on the wheel
  Conditions with_rim = at;
  with_rim.channels.push_back(kRimTemperature);
  PlannedTest test =
      make_test("rim_thermocouple", "thermocouple on the rim: 20 min at 120 km/h, then 45 min at standstill, lifted", 0,
                short_soak(with_rim).runs);
  test.hours += kFitting_h;
  test.extra.rim_thermocouple = true;
  return test;
}

PlannedTest soak_with_pressure(const Conditions& at) {
  RunPlan run = begin_warm(at);
  run.stand(150.0, 0.0);
  return make_test("soak_with_pressure", "soak for 150 min after a run, pressure and liner temperature logged", 0,
                   {run.finish()});
}

PlannedTest speed_steps(const Conditions& at) {
  RunPlan run = begin_cold(at);
  for (const double speed_km_h : {80.0, 120.0, 40.0}) run.roll(20.0, at.load_N, speed_km_h);
  return make_test("speed_steps", fmt::format("80, 120 and 40 km/h, 20 min each, at {:.0f} N from cold", at.load_N), 1,
                   {run.finish()});
}

PlannedTest pressure_sweep(const Conditions& at) {
  constexpr double kStep_Pa = 60e3;
  std::vector<scenarios::MeasuredRun> runs;
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

PlannedTest fast_steps(const Conditions& at) {
  RunPlan run = begin_warm(at);
  for (const double speed_km_h : {100.0, 110.0, 120.0, 130.0, 140.0}) run.roll(6.0, at.load_N, speed_km_h);
  return make_test("fast_steps", "fine speed steps from 100 to 140 km/h, 6 min each, on the warm tire", 0,
                   {run.finish()});
}

PlannedTest warm_surface(const Conditions& at) {
  constexpr double kWarmer_K = 15.0;  // Assumed: what heaters over a steel drum reach
  RunPlan run = begin_cold(at);
  run.on_surface(at.ambient_K + kWarmer_K).roll(40.0, at.load_N, kUsual_km_h);
  return make_test("warm_surface", "80 km/h from cold on a drum surface heated to 15 K above the ambient and recorded",
                   1, {run.finish()});
}

}  // namespace

std::vector<PlannedTest> make_test_menu(const PreparedSet& set) {
  const Conditions at = find_conditions(set);
  std::vector<PlannedTest> menu;
  for (const auto make : {skim_at_loads, skim_at_loads_hot, load_sweep, drum_alone, standstill_torque, load_off_and_on,
                          rests, speed_steps_hot, speed_steps_with_pulse, short_soak, rim_thermocouple,
                          soak_with_pressure, speed_steps, pressure_sweep, fast_steps, warm_surface}) {
    menu.push_back(make(at));
  }
  return menu;
}

}  // namespace rollrig::diagnosis
