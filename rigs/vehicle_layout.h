#pragma once
/// A vehicle on its rollers or on the road as the equations take it: the wheels that are simulated, and what
/// of the vehicle each of them stands for.

#include <optional>
#include <string>
#include <vector>

#include "models/corner.h"
#include "models/vehicle/powertrain_map.h"
#include "models/vehicle/vehicle.h"
#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"

namespace rollrig::rigs {

/// One simulated wheel. Shares are of the force that acts on all that is simulated.
struct WheelPlace {
  std::string position;  // "front_left"; empty when it is the only one
  std::size_t axle = 0;  // index in the vehicle's file
  double static_load_N = 0.0;
  double motor_share = 0.0;     // of the motor's force
  double friction_share = 0.0;  // of the friction brakes' force
  double axle_x_m = 0.0;        // from the center of gravity, forwards
  double pressure_Pa = 0.0;     // soaked, gauge; 0: as the run says
  VehicleSuspension suspension;
};

/// The whole vehicle on its wheels, or one wheel with its share of mass and force. What that wheel does not drive or
/// brake itself reaches it through the roller or the body, as the force of the other wheels would.
struct VehicleLayout {
  models::MachineTraits machine;
  double share = 1.0;  // of the vehicle that is simulated
  double mass_kg = 0.0;
  double rotating_mass_kg = 0.0;
  double rolling_load_N = 0.0;  // on the simulated wheels: less than the weight where an axle stands still
  double drag_area_m2 = 0.0;
  bool is_drag_in_resistance = false;  // that of still air: the drag area acts for the wind alone
  double air_density_kg_per_m3 = 0.0;
  double motor_limit_N = 0.0;  // most that the motor brakes
  double regeneration_fade_m_s = 0.0;
  double driver_bandwidth_rad_s = 0.0;  // of the rollers' common speed as well
  double roller_radius_m = 0.0;         // 0 on the road
  double body_height_m = 0.0;           // of the center of gravity above rollers or road
  TieDownParameters tie_down = {};
  /// Force of the rollers against the vehicle (§3.4.3, (3.20)); on the road, the road load of a vehicle
  /// that is given by it alone.
  models::RoadLoad<double> resistance = {};
  std::vector<WheelPlace> wheels = {};
  /// Where it is given, the energy of the battery is an integral of its own, over the whole vehicle's power.
  std::optional<models::PowertrainMap> powertrain_map = {};
};

/// Drag of the air against the vehicle on a road; where the resistance holds that of still air, what the wind adds.
/// Equation  F = rho/2 CdA u |u|, u = v + w; less rho/2 CdA v |v| where the resistance holds it
/// Symbols   v speed, w wind along the road, positive against the vehicle [m/s]; CdA drag area [m2]
/// Checked   tests/rigs/vehicle_fidelities_test.cpp
template <class S>
S calc_air_drag_N(const VehicleLayout& layout, const S& air_density_ratio, const S& speed_m_s, const S& wind_m_s) {
  const S density_kg_per_m3 = layout.air_density_kg_per_m3 * air_density_ratio;
  const S area_m2(layout.drag_area_m2);
  const S drag_N = models::calc_drag_N(density_kg_per_m3, area_m2, speed_m_s, wind_m_s);
  if (!layout.is_drag_in_resistance) return drag_N;
  return drag_N - models::calc_drag_N(density_kg_per_m3, area_m2, speed_m_s, S(0.0));
}

/// Names of an axle's wheels from left to right: by its side, of dual tires also outer and inner; a single wheel has
/// its axle's name. Throws InputError for any other number of wheels.
std::vector<std::string> name_wheels(const VehicleFile& vehicle, const VehicleAxle& axle);

/// Weight of what a wheel's suspension does not carry.
double calc_unsprung_N(const VehicleSuspension& suspension, const models::TireParameters<double>& tire);

/// Whether an axle rolls: on a dynamometer with rollers under the driven wheels alone, the others stand.
bool rolls(const VehicleAxle& axle, const RigFile& rig);

/// The layout of a vehicle with all its wheels that roll, or of one wheel of an axle with its share. On the flat,
/// `resistance` is the vehicle's road load where it has one, else nothing: drag and tires act by themselves. On a
/// dynamometer it is `set_load`.
VehicleLayout make_whole_vehicle(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                                 const models::RoadLoad<double>& set_load);
VehicleLayout make_one_wheel(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                             const models::RoadLoad<double>& set_load, std::size_t axle);

/// What the equations take of a tire under a vehicle on a rig. A vehicle that is given by its road load rolls
/// on the road without any loss in its tires, since that load contains them. Throws InputError.
models::Context<double> make_vehicle_context(const models::TireFile& tire, const RigFile& rig,
                                             const VehicleFile& vehicle, models::Baseline baseline);

}  // namespace rollrig::rigs
