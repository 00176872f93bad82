#include "rigs/vehicle_layout.h"

#include "models/vehicle/vehicle.h"

namespace rollrig::rigs {
namespace {

constexpr double kDriverBandwidth_rad_s = 3.0;  // Assumed: on the road

bool is_driven(const VehicleFile& vehicle, bool front) {
  return vehicle.driven_axle == DrivenAxle::kAll || (vehicle.driven_axle == DrivenAxle::kFront) == front;
}

/// A wheel of the whole vehicle; both wheels of an axle are alike.
WheelPlace make_wheel(const VehicleFile& vehicle, bool front, const std::string& position) {
  const double axle_share = front ? vehicle.geometry.front_load_share : 1.0 - vehicle.geometry.front_load_share;
  const double brake_share = front ? vehicle.brakes.front_share : 1.0 - vehicle.brakes.front_share;
  const double driven_wheels = vehicle.driven_axle == DrivenAxle::kAll ? 4.0 : 2.0;
  WheelPlace wheel;
  wheel.position = position;
  wheel.is_front = front;
  wheel.is_driven = is_driven(vehicle, front);
  wheel.static_load_N = vehicle.body.mass_kg * kStandardGravity_m_s2 * axle_share / 2.0;
  wheel.motor_share = wheel.is_driven ? 1.0 / driven_wheels : 0.0;
  wheel.friction_share = brake_share / 2.0;
  wheel.axle_x_m = vehicle.geometry.wheelbase_m *
                   (front ? 1.0 - vehicle.geometry.front_load_share : -vehicle.geometry.front_load_share);
  return wheel;
}

/// Where one axle stands still, the other's friction brakes do it all.
WheelPlace make_rolling_wheel(const VehicleFile& vehicle, const RigFile& rig, bool front, const std::string& position) {
  WheelPlace wheel = make_wheel(vehicle, front, position);
  if (!rolls(vehicle, rig, !front)) wheel.friction_share = 0.5;
  return wheel;
}

double find_rolling_load_N(const VehicleFile& vehicle, const RigFile& rig) {
  double load_N = 0.0;
  for (const bool front : {true, false}) {
    if (rolls(vehicle, rig, front)) load_N += 2.0 * make_wheel(vehicle, front, "").static_load_N;
  }
  return load_N;
}

models::RoadLoad<double> scale(const models::RoadLoad<double>& load, double factor) {
  return {factor * load.A_N, factor * load.B_N_s_per_m, factor * load.C_N_s2_per_m2};
}

/// All but the wheels, for a share of the vehicle.
VehicleLayout make_body(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                        const models::RoadLoad<double>& set_load, double share) {
  VehicleLayout layout;
  layout.machine = rig.kind->traits;
  layout.share = share;
  layout.mass_kg = share * vehicle.body.mass_kg;
  layout.rotating_mass_kg = share * vehicle.body.rotating_mass_kg;
  layout.rolling_load_N = share * find_rolling_load_N(vehicle, rig);
  layout.air_density_kg_per_m3 = models::calc_air_density_kg_per_m3(rig.environment.ambient_pressure_Pa, ambient_K);
  layout.motor_limit_N = layout.mass_kg * vehicle.powertrain.regeneration_limit_m_s2;
  layout.regeneration_fade_m_s = vehicle.powertrain.regeneration_fade_m_s;
  layout.driver_bandwidth_rad_s = is_on_road(layout.machine) ? kDriverBandwidth_rad_s : rig.drive.bandwidth_rad_s;
  layout.roller_radius_m = rig.drum.diameter_m / 2.0;
  layout.body_height_m = vehicle.geometry.centre_of_gravity_height_m;
  layout.suspension = vehicle.suspension;
  layout.tie_down = rig.tie_down;
  if (is_tied_down(layout.machine)) {
    layout.resistance = scale(set_load, share);
  } else if (vehicle.road_load.has_value()) {
    layout.resistance = scale(*vehicle.road_load, share);
  } else {
    layout.drag_area_m2 = share * vehicle.body.drag_area_m2;
  }
  return layout;
}

}  // namespace

bool rolls(const VehicleFile& vehicle, const RigFile& rig, bool front) {
  return !rig.driven_wheels_only || is_driven(vehicle, front);
}

VehicleLayout make_four_wheels(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                               const models::RoadLoad<double>& set_load) {
  VehicleLayout layout = make_body(vehicle, rig, ambient_K, set_load, 1.0);
  for (const char* position : {"front_left", "front_right", "rear_left", "rear_right"}) {
    const bool front = position[0] == 'f';
    if (rolls(vehicle, rig, front)) layout.wheels.push_back(make_rolling_wheel(vehicle, rig, front, position));
  }
  return layout;
}

VehicleLayout make_quarter(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                           const models::RoadLoad<double>& set_load, QuarterWheel which) {
  WheelPlace wheel = make_rolling_wheel(vehicle, rig, which == QuarterWheel::kFront, "");
  const double share = wheel.static_load_N / find_rolling_load_N(vehicle, rig);
  VehicleLayout layout = make_body(vehicle, rig, ambient_K, set_load, share);
  wheel.motor_share /= share;
  wheel.friction_share /= share;
  wheel.axle_x_m = 0.0;
  layout.wheels = {wheel};
  return layout;
}

models::Context<double> make_vehicle_context(const models::TireFile& tire, const RigFile& rig,
                                             const VehicleFile& vehicle, models::Baseline baseline) {
  models::Context<double> context = make_context(tire, rig, baseline);
  if (is_on_road(context.machine) && vehicle.road_load.has_value()) {
    context.tire.own = {&models::find_tire_model(models::kConstantModel), {}};
    context.tire.constant.rrc = 0.0;
  }
  return context;
}

}  // namespace rollrig::rigs
