#include "rigs/multibody/vehicle_drive.h"

#include <cmath>
#include <utility>

namespace rollrig::rigs {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;

namespace {

constexpr double kSynchronousBandwidth_rad_s = 20.0;  // Assumed: electrically coupled rollers
constexpr double kGuessedRollingLoss = 0.01;          // Assumed: driver's guess; his integral finds the rest

double fade(double speed_m_s) { return models::calc_standstill_fade(speed_m_s); }

}  // namespace

VehicleDrive::VehicleDrive(const SimTK::GeneralForceSubsystem& forces, std::vector<WheelContact> contacts,
                           const VehicleBodies& bodies, const VehicleLayout& layout, const PresentProgram& present)
    : RigForces(forces, std::move(contacts), 1),
      bodies_(bodies),
      layout_(layout),
      present_(present),
      total_mass_kg_(layout.mass_kg + layout.rotating_mass_kg) {}

models::InputPort<double> VehicleDrive::read_program(const State& state, std::size_t wheel) const {
  models::InputPort<double> inputs;
  read_vehicle_inputs(present_, state.getTime(), inputs);
  inputs.load_N = layout_.wheels[wheel].static_load_N;
  return inputs;
}

/// Drag and given road load, against the body's motion.
double VehicleDrive::calc_body_drag_N(double speed_m_s, const models::InputPort<double>& acting) const {
  if (!is_on_road()) return 0.0;
  return calc_air_drag_N(layout_, acting.air_density_ratio, speed_m_s, acting.wind_m_s) +
         models::calc_faded_road_load_N(layout_.resistance, speed_m_s);
}

double VehicleDrive::calc_feedforward_N(const models::InputPort<double>& acting) const {
  const double speed_m_s = acting.speed_m_s;
  const double rolling_N = kGuessedRollingLoss * layout_.mass_kg * kStandardGravity_m_s2 * fade(speed_m_s);
  if (is_on_road()) {
    return rolling_N + calc_body_drag_N(speed_m_s, acting) + models::calc_grade_N(layout_.mass_kg, acting.slope);
  }
  return rolling_N + models::calc_faded_road_load_N(layout_.resistance, speed_m_s);
}

double VehicleDrive::find_integral_m(double force_N, const models::InputPort<double>& acting) const {
  return (force_N - calc_feedforward_N(acting) - total_mass_kg_ * acting.acceleration_m_s2) /
         (total_mass_kg_ * layout_.driver_bandwidth_rad_s * layout_.driver_bandwidth_rad_s);
}

void VehicleDrive::find_speed(const State& state, DriveEvaluation& at) const {
  if (is_on_road()) {
    at.speed_m_s = bodies_.sled.getOneU(state, 0);
    return;
  }
  // The mean by inertia, so that what keeps the rollers at one pace only moves energy between them.
  double mass_kg = 0.0;
  for (const VehicleBodies::Wheel& wheel : bodies_.wheels) {
    at.speed_m_s += wheel.roller_mass_kg * wheel.roller.getOneU(state, 0) * layout_.roller_radius_m;
    mass_kg += wheel.roller_mass_kg;
  }
  at.speed_m_s /= mass_kg;
}

void VehicleDrive::find_demand(const State& state, DriveEvaluation& at) const {
  if (!present_.drive_on) return;
  const double bandwidth_rad_s = layout_.driver_bandwidth_rad_s;
  at.speed_error_m_s = at.acting.speed_m_s - at.speed_m_s;
  at.demand_N = calc_feedforward_N(at.acting) +
                total_mass_kg_ * (at.acting.acceleration_m_s2 + 2.0 * bandwidth_rad_s * at.speed_error_m_s +
                                  bandwidth_rad_s * bandwidth_rad_s * own_states(state)[0]);
}

void VehicleDrive::find_suspension(const State& state, std::size_t i, DriveEvaluation& at) const {
  const SimTK::MobilizedBody& upright = bodies_.wheels[i].upright;
  const VehicleSuspension& suspension = layout_.wheels[i].suspension;
  DriveEvaluation::Wheel& out = at.wheels[i];
  // The slider moves the upright upwards against the body; the spring pushes it downwards.
  out.suspension_N = bodies_.wheels[i].preload_N + suspension.stiffness_N_per_m * upright.getOneQ(state, 0);
  out.suspension_damper_N = suspension.damping_N_s_per_m * upright.getOneU(state, 0);
}

/// Body and uprights are pressed so that every contact at rest has its own restraint, though the body cannot pitch: it
/// sinks by what its springs need to carry the body's part of the restraint over tires that are pressed in.
void VehicleDrive::share_restraint(DriveEvaluation& at) const {
  double on_body_N = 0.0;
  double stiffness_N_per_m = 0.0;
  double pressed_in_N = 0.0;
  for (std::size_t i = 0; i < at.wheels.size(); ++i) {
    const double spring_N_per_m = layout_.wheels[i].suspension.stiffness_N_per_m;
    on_body_N += at.wheels[i].restraint_N;
    stiffness_N_per_m += spring_N_per_m;
    pressed_in_N += spring_N_per_m * at.wheels[i].restraint_N / tire_N_per_m(i);
  }
  at.sinks_m = (on_body_N + pressed_in_N) / stiffness_N_per_m;
  for (std::size_t i = 0; i < at.wheels.size(); ++i) {
    DriveEvaluation::Wheel& wheel = at.wheels[i];
    const double spring_m = at.sinks_m - wheel.restraint_N / tire_N_per_m(i);
    wheel.on_body_N = on_body_N / static_cast<double>(at.wheels.size());
    wheel.on_upright_N = wheel.restraint_N - layout_.wheels[i].suspension.stiffness_N_per_m * spring_m;
  }
}

void VehicleDrive::find_wheel(const State& state, std::size_t i, const models::ForceDemand<double>& demand,
                              DriveEvaluation& at) const {
  const WheelPlace& place = layout_.wheels[i];
  DriveEvaluation::Wheel& out = at.wheels[i];
  const double load_N = i == 0 ? at.acting.load_N : find_acting(state, i, read_program(state, i)).load_N;
  out.restraint_N = load_N - place.static_load_N;
  out.radius_m = calc_loaded_radius_m(contacts()[i].tire(), place.static_load_N + out.restraint_N);
  const double radius_m = out.radius_m;
  const double rim_m_s = bodies_.wheels[i].wheel.getOneU(state, 0) * radius_m;
  const double friction_N = place.friction_share * demand.friction_N;
  out.motor_Nm = place.motor_share * demand.motor_N * radius_m;
  out.brake_Nm = friction_N * radius_m * fade(rim_m_s);
  at.assist_N -= place.motor_share * demand.motor_N - friction_N * fade(at.speed_m_s);
  find_suspension(state, i, at);
  if (is_on_road()) return;
  const double share = place.static_load_N / layout_.rolling_load_N;
  const double roller_m_s = bodies_.wheels[i].roller.getOneU(state, 0) * layout_.roller_radius_m;
  const double set_N = share * fade(roller_m_s) * models::calc_road_load_N(layout_.resistance, roller_m_s);
  const double own_N = models::calc_faded_parasitic_N(contacts()[i].corner().context().parasitic, roller_m_s);
  const double keep_pace_N =
      bodies_.wheels[i].roller_mass_kg * kSynchronousBandwidth_rad_s * (at.speed_m_s - roller_m_s);
  out.roller_Nm = (own_N - set_N + keep_pace_N) * layout_.roller_radius_m;
}

/// What a hub does to its roller is shared by all rollers, each by its inertia, so that driven and undriven
/// ones keep one speed without lagging.
void VehicleDrive::share_among_rollers(DriveEvaluation& at) const {
  const auto hub_N = [&at](std::size_t i) {
    return (at.wheels[i].motor_Nm - at.wheels[i].brake_Nm) / at.wheels[i].radius_m;
  };
  double all_N = 0.0;
  for (std::size_t i = 0; i < at.wheels.size(); ++i) all_N += hub_N(i);
  for (std::size_t i = 0; i < at.wheels.size(); ++i) {
    const double share = layout_.wheels[i].static_load_N / layout_.rolling_load_N;
    at.wheels[i].roller_Nm += (share * all_N - hub_N(i)) * layout_.roller_radius_m;
  }
}

void VehicleDrive::evaluate(const State& state, DriveEvaluation& at) const {
  at = {};
  at.wheels.resize(bodies_.wheels.size());
  at.acting = find_acting(state, 0, read_program(state, 0));
  find_speed(state, at);
  find_demand(state, at);
  const models::ForceDemand<double> demand =
      present_.drive_on && models::is_held(at.acting)
          ? models::ForceDemand<double>{at.demand_N, 0.0}
          : models::blend_brakes(at.demand_N, layout_.motor_limit_N, at.speed_m_s, layout_.regeneration_fade_m_s);
  at.motor_N = demand.motor_N;
  at.assist_N = demand.motor_N - demand.friction_N * fade(at.speed_m_s);  // less what the own wheels do
  for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) find_wheel(state, i, demand, at);
  share_restraint(at);
  if (is_on_road()) {
    at.drag_N = calc_body_drag_N(at.speed_m_s, at.acting);
    at.grade_N = models::calc_grade_N(layout_.mass_kg, at.acting.slope);
  } else if (bodies_.has_sled()) {
    share_among_rollers(at);
    at.tie_down_N = -layout_.tie_down.stiffness_N_per_m * bodies_.sled.getOneQ(state, 0);
    at.tie_down_damper_N = -layout_.tie_down.damping_N_s_per_m * bodies_.sled.getOneU(state, 0);
  }
}

models::InputPort<double> VehicleDrive::find_recorded(const State& state, std::size_t i) const {
  models::InputPort<double> recorded = read_program(state, i);
  const DriveEvaluation& at = evaluation(state);
  const double radius_m = at.wheels[i].radius_m;
  recorded.brake_force_N = std::abs(at.wheels[i].brake_Nm) / radius_m;
  recorded.longitudinal_force_N = (at.wheels[i].motor_Nm - at.wheels[i].brake_Nm) / radius_m;
  return recorded;
}

const DriveEvaluation& VehicleDrive::evaluation(const State& state) const {
  auto& entry = SimTK::Value<DriveEvaluation>::updDowncast(forces_.updCacheEntry(state, cache_)).upd();
  if (!forces_.isCacheValueRealized(state, cache_)) {
    evaluate(state, entry);
    forces_.markCacheValueRealized(state, cache_);
  }
  return entry;
}

/// Of the rest of the vehicle, on each roller.
double VehicleDrive::calc_assist_Nm(const DriveEvaluation& at) const {
  return at.assist_N * layout_.roller_radius_m / static_cast<double>(at.wheels.size());
}

void VehicleDrive::allocate_own_caches(State& state) const {
  cache_ = forces_.allocateLazyCacheEntry(state, SimTK::Stage::Velocity, new SimTK::Value<DriveEvaluation>());
}

void VehicleDrive::add_own_forces(const State& state, const Contacts&, SimTK::Vector_<SpatialVec>& body_forces,
                                  SimTK::Vector& mobility_forces) const {
  const DriveEvaluation& at = evaluation(state);
  const Vec3 up(0, 1, 0);
  double along_N = -at.drag_N - at.grade_N + (is_on_road() ? at.assist_N : 0.0);
  along_N += at.tie_down_N + at.tie_down_damper_N;
  SpatialVec& on_body = body_forces[bodies_.body.getMobilizedBodyIndex()];
  on_body[1] += Vec3(along_N, 0, 0);
  for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
    const DriveEvaluation::Wheel& wheel = at.wheels[i];
    const VehicleBodies::Wheel& own = bodies_.wheels[i];
    SpatialVec& on_upright = body_forces[own.upright.getMobilizedBodyIndex()];
    own.upright.applyOneMobilityForce(state, 0, -(wheel.suspension_N + wheel.suspension_damper_N), mobility_forces);
    const double hub_Nm = wheel.motor_Nm - wheel.brake_Nm;  // about the wheel's own axis, the ground's -z
    body_forces[own.wheel.getMobilizedBodyIndex()][0] += Vec3(0, 0, -hub_Nm);
    on_upright[0] += Vec3(0, 0, hub_Nm);
    const Vec3 arm_m(layout_.wheels[i].axle_x_m, 0, 0);
    on_upright[1] -= wheel.on_upright_N * up;
    const Vec3 down_N = -(wheel.on_body_N + own.ballast_N) * up;
    on_body += SpatialVec(SimTK::cross(arm_m, down_N), down_N);
    if (is_on_road()) continue;
    body_forces[own.roller.getMobilizedBodyIndex()][0] += Vec3(0, 0, wheel.roller_Nm + calc_assist_Nm(at));
  }
}

void VehicleDrive::put_own_rates(const State& state, const Contacts&, double* z_rates) const {
  z_rates[0] = evaluation(state).speed_error_m_s;
}

/// Power of the roller's motor, of the rest of the vehicle through it, and of the restraint.
double VehicleDrive::calc_given_W(const State& state, std::size_t i) const {
  const DriveEvaluation& at = evaluation(state);
  const VehicleBodies::Wheel& own = bodies_.wheels[i];
  const DriveEvaluation::Wheel& wheel = at.wheels[i];
  const Vec3 axle_m_s = bodies_.body.findStationVelocityInGround(state, Vec3(layout_.wheels[i].axle_x_m, 0, 0));
  const Vec3 upright_m_s = own.upright.getBodyOriginVelocity(state);
  const double restraint_W = -(wheel.on_body_N + own.ballast_N) * axle_m_s[1] - wheel.on_upright_N * upright_m_s[1];
  if (is_on_road()) return restraint_W;
  return restraint_W + (wheel.roller_Nm + calc_assist_Nm(at)) * own.roller.getOneU(state, 0);
}

VehiclePowers<double> VehicleDrive::find_powers(const State& state) const {
  const DriveEvaluation& at = evaluation(state);
  VehiclePowers<double> power;
  double own_share = 0.0;  // of the motor, at the simulated hubs
  for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
    const double hub_rad_s = bodies_.wheels[i].wheel.getOneU(state, 0);  // against the upright, which may pitch
    own_share += layout_.wheels[i].motor_share;
    power.motor_W += at.wheels[i].motor_Nm * hub_rad_s;
    power.brake_W += at.wheels[i].brake_Nm * hub_rad_s;
    power.roller_W += calc_given_W(state, i);
    power.suspension_damper_W += at.wheels[i].suspension_damper_N * bodies_.wheels[i].upright.getOneU(state, 0);
  }
  if (is_on_road()) power.roller_W += (at.assist_N - at.grade_N) * at.speed_m_s;
  if (!is_on_road() && bodies_.has_sled()) {
    power.suspension_damper_W -= at.tie_down_damper_N * bodies_.sled.getOneU(state, 0);
  }
  power.drive_W = own_share > 0.0 ? power.motor_W / own_share : at.motor_N * at.speed_m_s;
  power.drag_W = at.drag_N * at.speed_m_s;
  return power;
}

double VehicleDrive::calc_own_springs_J(const State& state) const {
  double energy_J = 0.0;
  for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
    const double q_m = bodies_.wheels[i].upright.getOneQ(state, 0);
    energy_J +=
        bodies_.wheels[i].preload_N * q_m + models::calc_spring_J(layout_.wheels[i].suspension.stiffness_N_per_m, q_m);
  }
  if (is_on_road() || !bodies_.has_sled()) return energy_J;
  return energy_J + models::calc_spring_J(layout_.tie_down.stiffness_N_per_m, bodies_.sled.getOneQ(state, 0));
}

}  // namespace rollrig::rigs
