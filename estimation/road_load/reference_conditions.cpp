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
  const char* regulation = "accuracy that Regulation (EU) 2018/1832, Sub-Annex 4, 3.1 asks for, rectangular";
  const ReferenceCorrection& at = tested.correction;
  std::vector<RoadLoadSensor> list{{Kind::kSpeed, "vehicle speed", "speed_km_h", 0.2 / kKmhPerMs, regulation}};
  if (at.ambient_K.has_value()) {
    list.push_back({Kind::kAmbient, "air temperature", "ambient_degC", 1.0, regulation, *at.ambient_K});
    if (at.ambient_pressure_Pa.has_value()) {
      list.push_back(
          {Kind::kPressure, "air pressure", "ambient_pressure_kPa", 300.0, regulation, *at.ambient_pressure_Pa});
    }
  }
  if (at.wind_m_s != 0.0) {
    list.push_back({Kind::kWind, "wind speed", "wind_m_s", 0.3, regulation, std::abs(at.wind_m_s)});
  }
  list.push_back({Kind::kMass, "mass", "mass_kg", at.mass_kg > 4000.0 ? 20.0 : 10.0, regulation, at.mass_kg});
  if (tested.has_air_speed) {
    list.push_back({Kind::kAirSpeed, "air speed", "speed_km_h", 1.0 / kKmhPerMs,
                    "accuracy that SAE J2263 asks for (from a public summary), rectangular"});
  }
  if (tested.most_torque_Nm > 0.0) {
    list.push_back(
        {Kind::kTorque, "wheel torque", "torque_Nm", std::max(6.0, 0.005 * tested.most_torque_Nm), regulation});
  }
  if (tested.wheel_speed_Hz > 0.0) {
    list.push_back({Kind::kWheelSpeed, "wheel speed", "wheel_speed_Hz", 0.05, regulation, tested.wheel_speed_Hz});
  }
  return list;
}

Eigen::Vector3d apply_sensor_errors(const TestedRoadLoad& tested, const std::vector<RoadLoadSensor>& sensors,
                                    const std::vector<double>& errors_SI) {
  Eigen::Vector3d measured = tested.measured;
  ReferenceCorrection moved = tested.correction;
  double force_per_unit = tested.force_per_unit;
  double air_speed_error_m_s = 0.0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double e = errors_SI[i];
    switch (sensors[i].kind) {
      case RoadLoadSensorKind::kSpeed:
        measured += tested.by_speed.has_value()
                        ? Eigen::Vector3d(e * *tested.by_speed)
                        : Eigen::Vector3d(e * (e * measured(2) - measured(1)), -2.0 * e * measured(2), 0.0);
        if (tested.radius_speed_m_s > 0.0) force_per_unit /= 1.0 + e / tested.radius_speed_m_s;
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
        if (!tested.has_mass_correction) moved.corrected_to_mass_kg = moved.mass_kg;
        if (tested.in_proportion_to_mass) {
          measured *= (moved.mass_kg + tested.rotating_mass_kg) / (tested.correction.mass_kg + tested.rotating_mass_kg);
        }
        break;
      case RoadLoadSensorKind::kAirSpeed:
        air_speed_error_m_s = e;
        break;
      case RoadLoadSensorKind::kTorque:
        measured(0) += e;
        break;
      case RoadLoadSensorKind::kWheelSpeed:
        force_per_unit *= 1.0 + e / tested.wheel_speed_Hz;
        break;
    }
  }
  Eigen::Vector3d load = force_per_unit * correct_to_reference(measured, moved);
  load(1) -= 2.0 * air_speed_error_m_s * load(2);
  return load;
}

std::vector<SensorContribution> list_sensor_contributions(const TestedRoadLoad& tested) {
  const std::vector<RoadLoadSensor> sensors = list_road_load_sensors(tested);
  std::vector<double> errors(sensors.size(), 0.0);
  std::vector<SensorContribution> list;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double sd = sensors[i].half_width / std::sqrt(3.0);
    errors[i] = sd;
    const Eigen::Vector3d above = apply_sensor_errors(tested, sensors, errors);
    errors[i] = -sd;
    list.push_back({sensors[i], 0.5 * (above - apply_sensor_errors(tested, sensors, errors))});
    errors[i] = 0.0;
  }
  return list;
}

}  // namespace rollrig::estimation
