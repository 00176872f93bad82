#include "scenarios/common/iso_method_budgets.h"

#include <algorithm>
#include <cmath>

#include "models/wheel/rolling_wheel.h"

namespace rollrig::scenarios {
namespace {

// Half-widths of rectangular distributions for instruments of which no file says anything.
constexpr double kIsoGainLimit = 0.005;      // Assumed: of torque or force, a transducer of class 0.5
constexpr double kIsoAngleLimit_rad = 5e-5;  // Assumed: what tests in both directions of rotation leave
constexpr double kIsoTimeLimit = 0.001;      // Assumed: of speed over time, a counter and a clock
constexpr double kIsoInertiaLimit = 0.005;   // Assumed: of drum and wheel, by a known torque

double calc_by_torque_N(const ReadingOfMethod& reading) { return reading.value / reading.lever_m; }

double calc_by_force_N(const ReadingOfMethod& reading) {
  const double shown_N = reading.value + reading.at.load_N * std::sin(reading.own);
  const double curvature_per_m = reads_torque(reading.spec.rig.kind->traits) ? 1.0 / reading.lever_m : 0.0;
  return shown_N * models::calc_rolling_ratio(reading.radius_m(), curvature_per_m);
}

/// The speed is that of the shaft times the radius.
double calc_by_power_N(const ReadingOfMethod& reading) {
  return reading.value / (reading.at.speed_m_s * reading.speed_ratio * reading.lever_m / reading.spec.rig.lever_m());
}

/// A surface speed follows from the turning of the drum, so that a larger drum decelerates more.
double calc_by_deceleration_N(const ReadingOfMethod& reading) {
  const double drum_kg = reading.spec.rig.inertia() / (reading.lever_m * reading.lever_m);
  const double mass_kg = drum_kg + calc_spin_mass_kg(reading.spec.tire.values, reading.radius_m());
  return reading.own * mass_kg * reading.value * reading.lever_m / reading.spec.rig.lever_m();
}

const std::vector<MethodBudget>& list_method_budgets() {
  static const OwnInput angle{"angle of the force cell to the load", "angle_mrad", &IsoAccuracies::force_cell_angle_rad,
                              kIsoAngleLimit_rad, std::nullopt};
  static const OwnInput inertia{"inertias of drum and wheel", "gain_percent", &IsoAccuracies::inertia, kIsoInertiaLimit,
                                1.0};
  static const char* const radius = "the loaded radius of the tire";
  static const std::vector<MethodBudget> budgets{
      {kTorqueMethod,
       nullptr,
       nullptr,
       "zero of torque or force",
       "gain of torque or force",
       kIsoGainLimit,
       &calc_by_torque_N,
       std::nullopt,
       {}},
      {kForceMethod,
       &quantities::kSpindleForce,
       "force_N",
       "zero of the spindle force",
       "gain of the spindle force",
       kIsoGainLimit,
       &calc_by_force_N,
       angle,
       {radius}},
      {kPowerMethod,
       &quantities::kMotorPower,
       "power_W",
       "zero of the power",
       "gain of the power",
       kIsoGainLimit,
       &calc_by_power_N,
       std::nullopt,
       {"losses of the motor that are not the same loaded and in the skim test"}},
      {kDecelerationMethod,
       &quantities::kSpeed,
       "deceleration_m_s2",
       nullptr,
       "gain of speed over time",
       kIsoTimeLimit,
       &calc_by_deceleration_N,
       inertia,
       {radius,
        "the bias of the method: up to 0.4 % of the rolling resistance after the whole warm-up, up to 0.9 % after "
        "measurement cycles of 10 min, in which the tire still becomes warmer"}}};
  return budgets;
}

}  // namespace

const MethodBudget& find_method_budget(const std::string& method) {
  const auto& all = list_method_budgets();
  return *std::find_if(all.begin(), all.end(), [&method](const MethodBudget& one) { return one.method == method; });
}

Cycle evaluate_by_method(const Cycle& cycle, const MethodReadings& readings, const RunSpec& spec) {
  const MethodBudget& budget = find_method_budget(readings.method);
  const double own = budget.own.has_value() ? budget.own->value.value_or(readings.misalignment_rad) : 0.0;
  const auto calc_force_N = [&](const Reading& at, double value) {
    return budget.calc_force_N({spec, at, value, spec.rig.lever_m(), 1.0, own});
  };
  Cycle by_method = cycle;
  by_method.parasitic_N = calc_force_N(cycle.skim, readings.skim);
  by_method.rolling_resistance_N = calc_force_N(cycle.loaded, readings.loaded) - by_method.parasitic_N;
  by_method.rrc = by_method.rolling_resistance_N / cycle.loaded.load_N;
  return by_method;
}

const Quantity& find_channel(const RunSpec& spec, const MethodBudget& budget) {
  return budget.channel != nullptr ? *budget.channel : spec.rig.kind->traits.force;
}

bool has_sensor(const RunSpec& spec, const MethodBudget& budget) {
  return spec.sensors.has_value() && spec.sensors->count(find_channel(spec, budget)) > 0;
}

MethodSensor find_method_sensor(const RunSpec& spec, const MethodBudget& budget, double speed_m_s) {
  const std::string by_sensor = "noise, drift and resolution of the sensor, of the means over the two windows";
  if (budget.channel == nullptr) return {find_force_sensor(spec), by_sensor};
  if (has_sensor(spec, budget)) return {spec.sensors->at(*budget.channel), by_sensor};
  const double per_torque = (*budget.channel == quantities::kMotorPower ? speed_m_s : 1.0) / spec.rig.lever_m();
  models::SensorParameters sensor = find_force_sensor(spec);
  for (double* of : {&sensor.offset_sd, &sensor.drift_sd, &sensor.noise_sd, &sensor.resolution}) *of *= per_torque;
  return {sensor, "Assumed: a sensor as good as that of the torque; no file gives it", true};
}

std::string find_reading_key(const RunSpec& spec, const MethodBudget& budget) {
  return budget.reading_key != nullptr ? budget.reading_key : find_channel(spec, budget).header();
}

}  // namespace rollrig::scenarios
