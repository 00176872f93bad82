#pragma once
/// How a road load is found by a procedure.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#pragma GCC visibility push(default)
namespace rollrig {

enum class RoadLoadProcedureKind {
  kWltp,        // coastdown times at reference speeds, wind at a stationary place
  kJ2263,       // speed traces with the air flow at each sample; drag area by yaw angle
  kJ1263,       // speed traces with the wind at a stationary place; no B
  kTorqueMeter  // torque of the driven wheels at steady reference speeds
};

struct RoadLoadProcedureOptions {
  RoadLoadProcedureKind kind = RoadLoadProcedureKind::kWltp;
  std::optional<double> mass_kg;                // as tested, mean of before and after; absent: of a recording
  std::optional<double> rotating_mass_kg;       // absent: 3 % of that mass
  std::optional<double> corrected_to_mass_kg;   // test mass TM of the WLTP; absent: no correction for the mass
  double reference_temperature_K = 293.15;      // of all these procedures
  std::optional<double> reference_pressure_Pa;  // absent: 100 kPa (WLTP), 98.21 kPa (SAE)
  double rolling_fall_per_K = 8.6e-3;           // K0
  double speed_from_m_s = 15.0 / 3.6;
  double speed_to_m_s = std::numeric_limits<double>::infinity();
  int yaw_degree = 2;                    // of the polynomial of the drag area, 0 to 4
  std::optional<double> wheel_radius_m;  // dynamic radius, of a torque-meter test without wheel speeds
  bool sensor_accuracy = true;           // whether the accuracy of the sensors is part of the intervals
  std::vector<std::string> leave_out;    // runs: "7", or "session/7"
};

struct DefaultRoadLoadOptions {
  double mass_kg = 0.0;    // test mass
  double width_m = 0.0;    // of the vehicle
  double height_m = 0.0;   // of the vehicle
  std::string tire_class;  // C1, C2, C3; empty: no rolling resistance class
  double rrc_N_per_kN = 0.0;
};

}  // namespace rollrig
#pragma GCC visibility pop
