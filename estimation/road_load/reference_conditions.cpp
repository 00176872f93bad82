#include "estimation/road_load/reference_conditions.h"

#include <cmath>

namespace rollrig::estimation {

double ReferenceCorrection::rolling_factor() const {
  return ambient_K.has_value() ? 1.0 + rolling_fall_per_K * (*ambient_K - reference_temperature_K) : 1.0;
}

double ReferenceCorrection::air_factor() const {
  if (!ambient_K.has_value()) return 1.0;
  return *ambient_K / reference_temperature_K * reference_pressure_Pa /
         ambient_pressure_Pa.value_or(reference_pressure_Pa);
}

Eigen::Vector3d correct_to_reference(const Eigen::Vector3d& measured, const ReferenceCorrection& correction) {
  const double wind = measured(2) * correction.wind_m_s * correction.wind_m_s;
  const double mass = measured(0) * (1.0 - correction.corrected_to_mass_kg / correction.mass_kg);
  const double rolling = correction.rolling_factor();
  return {rolling * (measured(0) - wind - mass), rolling * measured(1), correction.air_factor() * measured(2)};
}

std::vector<SensorContribution> list_sensor_contributions(const Eigen::Vector3d& measured,
                                                          const ReferenceCorrection& correction,
                                                          bool in_proportion_to_mass) {
  constexpr double kTemperature_K = 1.0;
  constexpr double kPressure_Pa = 300.0;
  constexpr double kWind_m_s = 0.3;
  const double mass_kg = correction.mass_kg > 4000.0 ? 20.0 : 10.0;
  const Eigen::Vector3d at = correct_to_reference(measured, correction);
  std::vector<SensorContribution> list;
  const auto add = [&](const char* name, double half_width, const Eigen::Vector3d& measured_moved,
                       const ReferenceCorrection& moved) {
    list.push_back({name, half_width, (correct_to_reference(measured_moved, moved) - at) / std::sqrt(3.0)});
  };
  if (correction.ambient_K.has_value()) {
    ReferenceCorrection moved = correction;
    *moved.ambient_K += kTemperature_K;
    add("air temperature", kTemperature_K, measured, moved);
    if (correction.ambient_pressure_Pa.has_value()) {
      moved = correction;
      *moved.ambient_pressure_Pa += kPressure_Pa;
      add("air pressure", kPressure_Pa, measured, moved);
    }
  }
  ReferenceCorrection moved = correction;
  if (correction.wind_m_s != 0.0) {
    moved.wind_m_s = std::abs(moved.wind_m_s) + kWind_m_s;
    add("wind speed", kWind_m_s, measured, moved);
    moved = correction;
  }
  moved.mass_kg += mass_kg;
  add("mass", mass_kg,
      in_proportion_to_mass ? Eigen::Vector3d(measured * moved.mass_kg / correction.mass_kg) : measured, moved);
  return list;
}

}  // namespace rollrig::estimation
