#pragma once
/// Runs of a menu of tests, written stage by stage.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/next_test/test_menu.h"

namespace rollrig::diagnosis {

constexpr double kUsual_km_h = 80.0;  // ISO 28580
constexpr double kWarmUp_min = 30.0;  // the source's warm-up

/// What does not change from test to test.
struct TestConditions {
  double load_N = 0.0;
  double skim_N = 0.0;
  double pressure_Pa = 0.0;
  double ambient_K = 0.0;
  std::vector<Quantity> channels;
  std::map<Quantity, double> held;  // further given columns, with what they hold unless a stage says otherwise
  Quantity hung;                    // the column of what hangs on the force sensor
};

/// The set's highest load, on which the tire is known to run, its middle pressure, and its kind's usual ambient.
TestConditions find_test_conditions(const PreparedSet& set);

/// A run from soaked at the ambient.
class RunPlan {
 public:
  RunPlan(const TestConditions& conditions, double first_km_h);

  /// Sets the load at once, goes to the speed by 1 km/h a second, then holds both for `minutes`.
  RunPlan& roll(double minutes, double load_N, double speed_km_h = kUsual_km_h, bool read = true);
  /// roll() at each of the loads, or of the speeds, in turn.
  RunPlan& roll_at_loads(double minutes, const std::vector<double>& loads_N, double speed_km_h = kUsual_km_h);
  RunPlan& roll_at_speeds(double minutes, double load_N, const std::vector<double>& speeds_km_h);
  RunPlan& stand(double minutes, double load_N, bool read = true) { return roll(minutes, load_N, 0.0, read); }
  /// Drive force of the wheel from now on, negative where it brakes.
  RunPlan& pull(double longitudinal_force_N);
  RunPlan& at_pressure(double pressure_Pa);
  RunPlan& on_surface(double surface_K);
  /// From now on a known torque or force, in the unit of the force channel, hangs on its sensor.
  RunPlan& hang(double torque_or_force);
  /// Sets the load at once, then lets the speed fall to another as the forces that `calc_slowing_m_s2` stands for
  /// slow what turns.
  RunPlan& coast(double load_N, double speed_km_h, const std::function<double(double speed_m_s)>& calc_slowing_m_s2);
  /// The whole run in the other direction of rotation.
  RunPlan& reversed();

  measurements::MeasuredRun finish();

 private:
  void add_row(double speed_km_h);

  TestConditions conditions_;
  measurements::MeasuredRun run_;
  double speed_km_h_;
  double load_N_ = 0.0;
  double surface_K_ = 0.0;  // 0: not recorded
  double hung_ = 0.0;
  std::vector<double> hung_by_row_;
  bool read_ = true;
};

/// A run on a warm tire: its first half hour at the usual speed is not read.
RunPlan begin_warm(const TestConditions& at);
RunPlan begin_cold(const TestConditions& at);

/// Conditions under which a further channel is read.
TestConditions read_too(TestConditions at, const Quantity& channel);
/// Conditions under which the rim's temperature is read as well, and a test that needs the thermocouple for it.
TestConditions read_rim_too(TestConditions at);
PlannedTest fit_rim_thermocouple(PlannedTest test);

/// A test of these runs, which it ends and names; its hours are those of set-up, of so many soaks and of the runs.
PlannedTest make_test(const char* id, std::string description, int soaks, std::vector<RunPlan> runs);

}  // namespace rollrig::diagnosis
