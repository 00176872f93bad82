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

/// What the accuracy of a sensor does to the corrected coefficients.
struct SensorContribution {
  std::string name;
  double half_width = 0.0;                           // of its accuracy, in SI units; a rectangular distribution
  Eigen::Vector3d change = Eigen::Vector3d::Zero();  // of the coefficients, by one standard deviation
};

/// Contributions of thermometer, barometer, anemometer and scale. The coefficients of a coastdown are in proportion to
/// the mass as measured; those of a torque are not.
/// Source    Regulation (EU) 2018/1832, 3.1 of Sub-Annex 4: 1 degC, 0.3 kPa, 0.3 m/s, 10 kg (20 kg above 4000 kg)
/// Checked   tests/estimation/reference_conditions_test.cpp
std::vector<SensorContribution> list_sensor_contributions(const Eigen::Vector3d& measured,
                                                          const ReferenceCorrection& correction,
                                                          bool in_proportion_to_mass);

}  // namespace rollrig::estimation
