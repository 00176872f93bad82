#pragma once
/// What sets the methods of ISO 28580 apart: how a reading becomes a force, and what it is uncertain by.

#include <optional>
#include <string>
#include <vector>

#include "models/sensor.h"
#include "scenarios/common/iso_uncertainty.h"

namespace rollrig::scenarios {

/// A reading of a method, at the values of the inputs.
struct ReadingOfMethod {
  const RunSpec& spec;
  const Reading& at;
  double value = 0.0;
  double lever_m = 0.0;      // of the drum's diameter as an input
  double speed_ratio = 1.0;  // speed as an input over that of the test
  double own = 0.0;          // the input that the method alone rests on

  double radius_m() const { return calc_loaded_radius_m(spec.tire.values, at.load_N); }
};

/// What a method alone rests on.
struct OwnInput {
  const char* name;
  const char* key;
  std::optional<double> IsoAccuracies::*accuracy;
  double assumed;
  std::optional<double> value;  // absent: the angle of the force cell, as the test has it
};

/// A method in the budget. Another method is another row of the list in iso_method_budgets.cpp.
struct MethodBudget {
  const char* method;
  const Quantity* channel;  // of its sensor; null: torque of the drum, of a belt force
  const char* reading_key;  // unit of the readings; null: that of this channel
  const char* zero_name;    // null: a slope over time has no zero
  const char* gain_name;
  double gain_limit;
  double (*calc_force_N)(const ReadingOfMethod& reading);  // at the surface
  std::optional<OwnInput> own;
  std::vector<const char*> left_out;

  /// Whether the readings are slopes of the speed over time.
  bool is_slope() const { return zero_name == nullptr; }
};

/// Of a method of list_iso_methods().
const MethodBudget& find_method_budget(const std::string& method);

/// A cycle whose F_r, F_pl and RRc are those of a method; its windows and means stay as they are.
/// Equation  F_r = F(X_t) - F_pl, F_pl = F(X_s), RRc = F_r/L;
///           torque        F(X) = X/R
///           force         F(X) = (X + L sin d) (1 + r/R)
///           power         F(X) = X/v
///           deceleration  F(X) = (I_D/R^2 + I_T/r^2) X
/// Symbols   X_t, X_s readings under load and in the skim test: torque [Nm], force of the spindle [N], mean mechanical
///           power of the motor [W], deceleration of the surface at the test speed [m/s2], of the solution of
///           dv/dt = -(a_0 + a_1 x + a_2 x^2) that fits the speed over time; L load [N], v speed of the surface [m/s],
///           each of its own window; R radius of the drum, r loaded radius of the tire at L [m]; d angle of the force
///           cell to the load [rad]; I_D inertia of the drum as the rig's file states it, I_T that of tire and wheel
///           [kg m2]. On a belt X is a force in the torque method, 1/R = 0 in the force method, and the belt's mass
///           stands for I_D/R^2
/// Validity  deceleration: no slip; the tire stays on the drum at the skim load, in place of being lifted, so that F_pl
///           has the loss of the tire there, as that of the other methods
/// Source    UN Regulation No. 117, Annex 6, and ISO 28580:2018, 7.6.3, 8.1.4 and 8.1.5 (the titles were read); there
///           the power method has 3.6 V A/U of the electric power V A and the speed U in km/h. Assumed: the losses of
///           the motor are the same loaded and in the skim test, and cancel. models/deceleration_method.h
/// Checked   tests/scenarios/iso_methods_test.cpp
Cycle evaluate_by_method(const Cycle& cycle, const MethodReadings& readings, const RunSpec& spec);

/// The channel that a method reads.
const Quantity& find_channel(const RunSpec& spec, const MethodBudget& budget);
/// Whether the run has a sensor of this channel.
bool has_sensor(const RunSpec& spec, const MethodBudget& budget);

/// What stands for the sensor of a method.
struct MethodSensor {
  models::SensorParameters sensor;
  std::string source;
  bool is_assumed = false;
};

/// The sensor of the run for the method's channel; else, of force and power, one as good as that of the torque.
MethodSensor find_method_sensor(const RunSpec& spec, const MethodBudget& budget, double speed_m_s);

/// A key with the unit of the method's readings.
std::string find_reading_key(const RunSpec& spec, const MethodBudget& budget);

}  // namespace rollrig::scenarios
