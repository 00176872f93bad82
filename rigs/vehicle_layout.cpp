#include "rigs/vehicle_layout.h"

#include <fmt/format.h>

#include "models/vehicle/vehicle.h"

namespace rollrig::rigs {
namespace {

constexpr double kDriverBandwidth_rad_s = 3.0;  // Assumed: on the road

double calc_wheel_load_N(const VehicleFile& vehicle, const VehicleAxle& axle) {
  return vehicle.body.mass_kg * kStandardGravity_m_s2 * axle.load_share / axle.wheels;
}

/// What the axles that roll have together. Where others stand still, they do all the braking.
struct RollingAxles {
  double load_N = 0.0;
  double brake_share = 0.0;
  double wheels = 0.0;

  RollingAxles(const VehicleFile& vehicle, const RigFile& rig) {
    for (const VehicleAxle& axle : vehicle.axles) {
      if (!rolls(axle, rig)) continue;
      load_N += axle.wheels * calc_wheel_load_N(vehicle, axle);
      brake_share += axle.brake_share;
      wheels += axle.wheels;
    }
  }
};

/// A wheel of the whole vehicle; all wheels of an axle are alike.
WheelPlace make_wheel(const VehicleFile& vehicle, std::size_t axle, const RollingAxles& rolling) {
  const VehicleAxle& own = vehicle.axles[axle];
  WheelPlace wheel;
  wheel.axle = axle;
  wheel.static_load_N = calc_wheel_load_N(vehicle, own);
  wheel.motor_share = own.drive_share / own.wheels;
  wheel.friction_share =
      rolling.brake_share > 0.0 ? own.brake_share / rolling.brake_share / own.wheels : 1.0 / rolling.wheels;
  wheel.axle_x_m = vehicle.calc_x_m(own);
  wheel.pressure_Pa = own.pressure_Pa;
  wheel.suspension = own.suspension;
  return wheel;
}

models::RoadLoad<double> scale(const models::RoadLoad<double>& load, double factor) {
  return {factor * load.A_N, factor * load.B_N_s_per_m, factor * load.C_N_s2_per_m2};
}

/// All but the wheels, for a share of the vehicle.
VehicleLayout make_body(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                        const models::RoadLoad<double>& set_load, double share) {
  VehicleLayout layout{rig.kind->traits};
  layout.share = share;
  layout.mass_kg = share * vehicle.body.mass_kg;
  layout.rotating_mass_kg = share * vehicle.body.rotating_mass_kg;
  layout.rolling_load_N = share * RollingAxles(vehicle, rig).load_N;
  layout.air_density_kg_per_m3 = models::calc_air_density_kg_per_m3(rig.environment.ambient_pressure_Pa, ambient_K);
  layout.motor_limit_N = layout.mass_kg * vehicle.powertrain.regeneration_limit_m_s2;
  layout.regeneration_fade_m_s = vehicle.powertrain.regeneration_fade_m_s;
  layout.driver_bandwidth_rad_s = is_on_road(layout.machine) ? kDriverBandwidth_rad_s : rig.drive.bandwidth_rad_s;
  layout.roller_radius_m = rig.drum.diameter_m / 2.0;
  layout.body_height_m = vehicle.center_of_gravity_height_m;
  layout.tie_down = rig.tie_down;
  layout.powertrain_map = vehicle.powertrain.map;
  if (is_tied_down(layout.machine)) {
    layout.resistance = scale(set_load, share);
  } else if (vehicle.road_load.has_value()) {
    layout.resistance = scale(*vehicle.road_load, share);
    layout.is_drag_in_resistance = true;
  }
  if (!is_tied_down(layout.machine)) layout.drag_area_m2 = share * vehicle.body.drag_area_m2;
  return layout;
}

}  // namespace

std::vector<std::string> name_wheels(const VehicleFile& vehicle, const VehicleAxle& axle) {
  const std::string left = axle.name + "_left";
  const std::string right = axle.name + "_right";
  if (axle.wheels == 1) return {axle.name};
  if (axle.wheels == 2) return {left, right};
  if (axle.wheels == 4) return {left + "_outer", left + "_inner", right + "_inner", right + "_outer"};
  throw InputError({fmt::format("axle '{}' of vehicle '{}' has {} wheels", axle.name, vehicle.name, axle.wheels),
                    vehicle.path, 0, "wheels", fmt::format("{}", axle.wheels),
                    "1, 2 or 4 wheels on an axle; in format /1 half of the tires are on each", ""});
}

double calc_unsprung_N(const VehicleSuspension& suspension, const models::TireParameters<double>& tire) {
  return kStandardGravity_m_s2 * (suspension.unsprung_mass_kg + tire.geometry.mass_kg + tire.geometry.wheel_mass_kg);
}

bool rolls(const VehicleAxle& axle, const RigFile& rig) { return !rig.driven_wheels_only || axle.drive_share > 0.0; }

VehicleLayout make_whole_vehicle(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                                 const models::RoadLoad<double>& set_load) {
  VehicleLayout layout = make_body(vehicle, rig, ambient_K, set_load, 1.0);
  const RollingAxles rolling(vehicle, rig);
  for (std::size_t axle = 0; axle < vehicle.axles.size(); ++axle) {
    if (!rolls(vehicle.axles[axle], rig)) continue;
    WheelPlace wheel = make_wheel(vehicle, axle, rolling);
    for (const std::string& position : name_wheels(vehicle, vehicle.axles[axle])) {
      wheel.position = position;
      layout.wheels.push_back(wheel);
    }
  }
  return layout;
}

VehicleLayout make_one_wheel(const VehicleFile& vehicle, const RigFile& rig, double ambient_K,
                             const models::RoadLoad<double>& set_load, std::size_t axle) {
  const RollingAxles rolling(vehicle, rig);
  WheelPlace wheel = make_wheel(vehicle, axle, rolling);
  const double share = wheel.static_load_N / rolling.load_N;
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
