#pragma once
/// What sets the methods of ISO 28580 apart in the uncertainty of their results.

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
  const Quantity* channel;      // of its sensor; null: torque of the drum, of a belt force
  const char* reading_key;      // unit of the readings; null: that of this channel
  double Cycle::*resistance_N;  // by this method in each cycle; null: the last cycle alone is evaluated
  const char* zero_name;        // null: a slope over time has no zero
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
