#pragma once
/// Coefficients of a resistance over speed, from the conditions of a test to those of reference.

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace rollrig::estimation {

/// Weather and mass of a test, and those of reference.
struct ReferenceCorrection {
  std::optional<double> ambient_K;            // mean of the test; absent: not corrected
  std::optional<double> ambient_pressure_Pa;  // likewise
  double wind_m_s = 0.0;                      // along the road, that opposite headings do not cancel
  double mass_kg = 0.0;                       // mean of before and after the test
  double corrected_to_mass_kg = 0.0;
  double rolling_fall_per_K = 8.6e-3;
  double reference_temperature_K = 293.15;
  double reference_pressure_Pa = 100e3;

  double rolling_factor() const;  // 1 + K0 (T - T0)
  double air_factor() const;      // K2
};

/// Equation  f0* = (f0 - w1 - K1)(1 + K0 (T - T0)),  f1* = f1 (1 + K0 (T - T0)),  f2* = K2 f2;
///           w1 = f2 v_w^2,  K1 = f0 (1 - TM/m_av),  K2 = (T/T0)(p0/p)
/// Symbols   f coefficients by powers of speed, of a force or of a torque; K0 [1/K]; T, p air; v_w wind [m/s];
///           TM mass to correct to, m_av mass as tested [kg]; all in SI units
/// Validity  air of 5 to 35 degC; a wind that is the same in both headings
/// Source    UN GTR 15 Annex 4, 4.5.1 to 4.5.5 (equations not from the text: docs/road_load_procedures.md);
///           that the wind is subtracted from f0: Regulation (EU) 2018/1832, 4.5.3.1.1 of Sub-Annex 4
/// Checked   tests/estimation/reference_conditions_test.cpp
Eigen::Vector3d correct_to_reference(const Eigen::Vector3d& measured, const ReferenceCorrection& correction);

/// A road load as tested, and what its force at reference conditions rests on.
struct TestedRoadLoad {
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  // coefficients of a force, or of a torque
  ReferenceCorrection correction;
  bool in_proportion_to_mass = true;        // a force from a deceleration
  double rotating_mass_kg = 0.0;            // that does not change with the mass; 0: a share of it
  bool has_mass_correction = false;         // else the mass to correct to is that of the test, its error included
  double force_per_unit = 1.0;              // of a torque: 1.02/r' [1/m]
  std::optional<Eigen::Vector3d> by_speed;  // change of `measured` by an error of the vehicle speed [1/(m/s)]; absent:
                                            // the curve moves along the speed
  bool has_air_speed = false;               // the air flow was measured on the vehicle
  double most_torque_Nm = 0.0;              // of the torque-meter method: the largest one measured
  double radius_speed_m_s = 0.0;            // at which r' was found; 0: r' is given, or not needed
  double wheel_speed_Hz = 0.0;              // turns of the wheels at that speed
};

enum class RoadLoadSensorKind { kSpeed, kAmbient, kPressure, kWind, kMass, kAirSpeed, kTorque, kWheelSpeed };

struct RoadLoadSensor {
  RoadLoadSensorKind kind = RoadLoadSensorKind::kMass;
  std::string name;
  std::string key;          // with its unit
  double half_width = 0.0;  // of its accuracy, in SI units; a rectangular distribution
  std::string source;       // of that
  double reading = 0.0;     // about which its error is; 0 where it read a range of values
};

/// The sensors that the road load rests on, with the accuracy that the regulation asks for: 0.2 km/h, 1 degC, 0.3 kPa,
/// 0.3 m/s, 10 kg (20 kg above 4000 kg), 6 Nm or 0.5 % of the largest torque, 0.05 turns a second; of an air speed
/// 1 km/h. What was not measured has no sensor, nor has a wind that opposite headings cancel.
/// Source    Regulation (EU) 2018/1832, 3.1 of Sub-Annex 4; air speed: SAE J2263, from a public summary
std::vector<RoadLoadSensor> list_road_load_sensors(const TestedRoadLoad& tested);

/// The road load at reference conditions, as found if each sensor read its entry of `errors_SI` too high.
/// Equation  correct_to_reference() of coefficients and conditions that have the errors. Vehicle speed e: F(v - e), that
///           is f0 - f1 e + f2 e^2 and f1 - 2 f2 e, or measured + by_speed e; r' = v/(2 pi n), times 1 + e/v_r. Air
///           speed e: f1 - 2 f2 e; the square of e is left out, as the fit of a curve without it would have it. Torque
///           e: c0 + e. Wheel speed e: r' over 1 + e/n
/// Symbols   v_r speed at which r' was found, n turns of the wheels a second there
/// Source    derived here; the speed of a regression on traces by that regression (evaluate_traces)
/// Checked   tests/estimation/reference_conditions_test.cpp, tests/estimation/procedure_uncertainty_test.cpp
Eigen::Vector3d apply_sensor_errors(const TestedRoadLoad& tested, const std::vector<RoadLoadSensor>& sensors,
                                    const std::vector<double>& errors_SI);

/// What the accuracy of a sensor does to the coefficients of the force.
struct SensorContribution {
  RoadLoadSensor sensor;
  Eigen::Vector3d change = Eigen::Vector3d::Zero();  // by one standard deviation
};
std::vector<SensorContribution> list_sensor_contributions(const TestedRoadLoad& tested);

}  // namespace rollrig::estimation
