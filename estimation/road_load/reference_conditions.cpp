#include "estimation/road_load/reference_conditions.h"

#include <algorithm>
#include <cmath>

#include "sim/core/units.h"

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

std::vector<RoadLoadSensor> list_road_load_sensors(const TestedRoadLoad& tested) {
  using Kind = RoadLoadSensorKind;
  const ReferenceCorrection& at = tested.correction;
  std::vector<RoadLoadSensor> list{{Kind::kSpeed, "vehicle speed", "speed_km_h", 0.2 / kKmhPerMs}};
  if (at.ambient_K.has_value()) {
    list.push_back({Kind::kAmbient, "air temperature", "ambient_degC", 1.0});
    if (at.ambient_pressure_Pa.has_value()) {
      list.push_back({Kind::kPressure, "air pressure", "ambient_pressure_kPa", 300.0});
    }
  }
  if (at.wind_m_s != 0.0) list.push_back({Kind::kWind, "wind speed", "wind_m_s", 0.3});
  list.push_back({Kind::kMass, "mass", "mass_kg", at.mass_kg > 4000.0 ? 20.0 : 10.0});
  if (tested.has_air_speed) list.push_back({Kind::kAirSpeed, "air speed", "speed_km_h", 1.0 / kKmhPerMs});
  if (tested.most_torque_Nm > 0.0) {
    list.push_back({Kind::kTorque, "wheel torque", "torque_Nm", std::max(6.0, 0.005 * tested.most_torque_Nm)});
  }
  if (tested.turns_at_radius_Hz > 0.0) list.push_back({Kind::kTurns, "wheel speed", "wheel_speed_Hz", 0.05});
  return list;
}

Eigen::Vector3d calc_road_load(const TestedRoadLoad& tested, const std::vector<RoadLoadSensor>& sensors,
                               const std::vector<double>& errors) {
  constexpr double kRadiusSpeed_m_s = 80.0 / kKmhPerMs;
  Eigen::Vector3d measured = tested.measured;
  ReferenceCorrection moved = tested.correction;
  double force_per_unit = tested.force_per_unit;
  double missing_f1 = 0.0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double e = errors[i];
    switch (sensors[i].kind) {
      case RoadLoadSensorKind::kSpeed:
        measured(0) += e * (e * measured(2) - measured(1));
        measured(1) -= 2.0 * e * measured(2);
        if (tested.turns_at_radius_Hz > 0.0) force_per_unit /= 1.0 + e / kRadiusSpeed_m_s;
        break;
      case RoadLoadSensorKind::kAmbient:
        *moved.ambient_K += e;
        break;
      case RoadLoadSensorKind::kPressure:
        *moved.ambient_pressure_Pa += e;
        break;
      case RoadLoadSensorKind::kWind:
        moved.wind_m_s = std::abs(moved.wind_m_s) + e;
        break;
      case RoadLoadSensorKind::kMass:
        moved.mass_kg += e;
        if (tested.in_proportion_to_mass) measured *= moved.mass_kg / tested.correction.mass_kg;
        break;
      case RoadLoadSensorKind::kAirSpeed:
        missing_f1 = 2.0 * e;
        break;
      case RoadLoadSensorKind::kTorque:
        measured(0) += e;
        break;
      case RoadLoadSensorKind::kTurns:
        force_per_unit *= 1.0 + e / tested.turns_at_radius_Hz;
        break;
    }
  }
  Eigen::Vector3d load = force_per_unit * correct_to_reference(measured, moved);
  load(1) -= missing_f1 * load(2);
  return load;
}

std::vector<SensorContribution> list_sensor_contributions(const TestedRoadLoad& tested) {
  const std::vector<RoadLoadSensor> sensors = list_road_load_sensors(tested);
  std::vector<double> errors(sensors.size(), 0.0);
  const Eigen::Vector3d at = calc_road_load(tested, sensors, errors);
  std::vector<SensorContribution> list;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    errors[i] = sensors[i].half_width;
    list.push_back({sensors[i], (calc_road_load(tested, sensors, errors) - at) / std::sqrt(3.0)});
    errors[i] = 0.0;
  }
  return list;
}

}  // namespace rollrig::estimation
