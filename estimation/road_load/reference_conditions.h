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
  bool in_proportion_to_mass = true;  // a force from a deceleration
  double force_per_unit = 1.0;        // of a torque: 1.02/r' [1/m]
  bool has_air_speed = false;         // the air flow was measured on the vehicle
  double most_torque_Nm = 0.0;        // of the torque-meter method: the largest one measured
  double turns_at_radius_Hz = 0.0;    // of the wheels where r' was found; 0: r' is given
};

/// What a sensor measures.
enum class RoadLoadSensorKind { kSpeed, kAmbient, kPressure, kWind, kMass, kAirSpeed, kTorque, kTurns };

struct RoadLoadSensor {
  RoadLoadSensorKind kind = RoadLoadSensorKind::kMass;
  std::string name;
  std::string key;          // with its unit
  double half_width = 0.0;  // of its accuracy, in SI units; a rectangular distribution
};

/// The sensors that the road load rests on, with the accuracy that the regulation asks for: 0.2 km/h, 1 degC, 0.3 kPa,
/// 0.3 m/s, 10 kg (20 kg above 4000 kg), 6 Nm or 0.5 % of the largest torque, 0.05 turns a second; of an air speed
/// 1 km/h. An air speed or a torque that was not measured has no sensor.
/// Source    Regulation (EU) 2018/1832, 3.1 of Sub-Annex 4; air speed: SAE J2263, from a public summary
std::vector<RoadLoadSensor> list_road_load_sensors(const TestedRoadLoad& tested);

/// The coefficients of the force at reference conditions with what sensors read too high, one error each.
/// Equation  correct_to_reference() of coefficients and conditions that have the errors. A speed that reads e too high
///           makes f0 too small by f1 e - f2 e^2 and f1 by 2 f2 e; an air speed makes 2 f2 e of f1 missing; a torque is
///           added to c0; r' = v/(2 pi n) at 80 km/h
/// Symbols   v speed, n turns of the wheels a second
/// Checked   tests/estimation/reference_conditions_test.cpp
Eigen::Vector3d calc_road_load(const TestedRoadLoad& tested, const std::vector<RoadLoadSensor>& sensors,
                               const std::vector<double>& errors);

/// What the accuracy of a sensor does to the coefficients of the force.
struct SensorContribution {
  RoadLoadSensor sensor;
  Eigen::Vector3d change = Eigen::Vector3d::Zero();  // by one standard deviation
};
std::vector<SensorContribution> list_sensor_contributions(const TestedRoadLoad& tested);

}  // namespace rollrig::estimation
