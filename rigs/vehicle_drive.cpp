#include "rigs/vehicle_drive.h"

#include <cmath>

namespace rollrig::rigs {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;

namespace {

constexpr double kSynchronousBandwidth_rad_s = 20.0;  // Assumed: electrically coupled rollers
constexpr double kGuessedRollingLoss = 0.01;          // Assumed: driver's guess; his integral finds the rest

double fade(double speed_m_s) { return models::calc_standstill_fade(speed_m_s); }

}  // namespace

VehicleDrive::VehicleDrive(const SimTK::GeneralForceSubsystem& forces, const SimTK::SimbodyMatterSubsystem& matter,
                           Bodies bodies, const VehicleLayout& layout, const VehicleFile& vehicle, const RigFile& rig,
                           const models::Context<double>& context)
    : forces_(forces),
      matter_(matter),
      bodies_(std::move(bodies)),
      layout_(layout),
      suspension_(vehicle.suspension),
      tie_down_(rig.tie_down),
      bandwidth_rad_s_(rig.kind == RigKind::kFlat ? 3.0 : rig.drive.bandwidth_rad_s),
      roller_radius_m_(rig.drum.diameter_m / 2.0),
      context_(context),
      total_mass_kg_(layout.mass_kg + layout.rotating_mass_kg) {}

/// Drag and given road load, against the body's motion.
double VehicleDrive::calc_body_drag_N(double speed_m_s, const models::InputPort<double>& acting) const {
  if (!is_flat()) return 0.0;
  const double density_kg_per_m3 = layout_.air_density_kg_per_m3 * acting.air_density_ratio;
  return models::calc_drag_N(density_kg_per_m3, layout_.drag_area_m2, speed_m_s, acting.wind_m_s) +
         fade(speed_m_s) * models::calc_road_load_N(layout_.resistance, speed_m_s);
}

double VehicleDrive::calc_feedforward_N(const models::InputPort<double>& acting) const {
  const double speed_m_s = acting.speed_m_s;
  const double rolling_N = kGuessedRollingLoss * layout_.mass_kg * kStandardGravity_m_s2 * fade(speed_m_s);
  if (is_flat()) {
    return rolling_N + calc_body_drag_N(speed_m_s, acting) + models::calc_grade_N(layout_.mass_kg, acting.slope);
  }
  return rolling_N + fade(speed_m_s) * models::calc_road_load_N(layout_.resistance, speed_m_s);
}

double VehicleDrive::find_integral_m(double force_N, const models::InputPort<double>& acting) const {
  return (force_N - calc_feedforward_N(acting) - total_mass_kg_ * acting.acceleration_m_s2) /
         (total_mass_kg_ * bandwidth_rad_s_ * bandwidth_rad_s_);
}

void VehicleDrive::find_speed(const State& state, DriveEvaluation& at) const {
  if (is_flat()) {
    at.speed_m_s = matter_.getMobilizedBody(bodies_.sled).getOneU(state, 0);
    return;
  }
  // The mean by inertia, so that what keeps the rollers at one pace only moves energy between them.
  double mass_kg = 0.0;
  for (const Wheel& wheel : bodies_.wheels) {
    at.speed_m_s += wheel.roller_mass_kg * matter_.getMobilizedBody(wheel.roller).getOneU(state, 0) * roller_radius_m_;
    mass_kg += wheel.roller_mass_kg;
  }
  at.speed_m_s /= mass_kg;
}

void VehicleDrive::find_demand(const State& state, DriveEvaluation& at) const {
  if (!driver_on_) return;
  at.speed_error_m_s = at.acting.speed_m_s - at.speed_m_s;
  at.demand_N = calc_feedforward_N(at.acting) +
                total_mass_kg_ * (at.acting.acceleration_m_s2 + 2.0 * bandwidth_rad_s_ * at.speed_error_m_s +
                                  bandwidth_rad_s_ * bandwidth_rad_s_ * forces_.getZ(state)[integral_z_]);
}

void VehicleDrive::find_suspension(const State& state, std::size_t i, DriveEvaluation& at) const {
  const SimTK::MobilizedBody& upright = matter_.getMobilizedBody(bodies_.wheels[i].upright);
  DriveEvaluation::Wheel& out = at.wheels[i];
  // The slider moves the upright upwards against the body; the spring perturbations it downwards.
  out.suspension_N = bodies_.wheels[i].preload_N + suspension_.stiffness_N_per_m * upright.getOneQ(state, 0);
  out.suspension_damper_N = suspension_.damping_N_s_per_m * upright.getOneU(state, 0);
}

/// What presses on a wheel beyond its share of the weight.
double VehicleDrive::find_restraint_N(const State& state, std::size_t i, const DriveEvaluation& at) const {
  const double static_N = layout_.wheels[i].static_load_N;
  if (i == 0) return at.acting.load_N - static_N;
  models::Instant<double> now;
  now.recorded = program_inputs(state.getTime());
  now.recorded.load_N = static_N;
  bodies_.wheels[i].contact->apply_inputs(state, now);
  return now.acting.load_N - static_N;
}

/// Body and uprights are pressed so that every contact at rest has its own restraint, though the body cannot pitch.
void VehicleDrive::share_restraint(DriveEvaluation& at) const {
  double mean_N = 0.0;
  for (const DriveEvaluation::Wheel& wheel : at.wheels) mean_N += wheel.restraint_N;
  mean_N /= static_cast<double>(at.wheels.size());
  const double give = suspension_.stiffness_N_per_m / context_.tire.stiffness.vertical_N_per_m;
  for (DriveEvaluation::Wheel& wheel : at.wheels) {
    wheel.on_body_N = mean_N;
    wheel.on_upright_N = (wheel.restraint_N - mean_N) * (1.0 + give);
  }
}

void VehicleDrive::find_wheel(const State& state, std::size_t i, const models::ForceDemand<double>& demand,
                              DriveEvaluation& at) const {
  const WheelPlace& place = layout_.wheels[i];
  DriveEvaluation::Wheel& out = at.wheels[i];
  out.restraint_N = find_restraint_N(state, i, at);
  out.radius_m = calc_loaded_radius_m(context_.tire, place.static_load_N + out.restraint_N);
  const double radius_m = out.radius_m;
  const double rim_m_s = matter_.getMobilizedBody(bodies_.wheels[i].wheel).getOneU(state, 0) * radius_m;
  const double friction_N = place.friction_share * demand.friction_N;
  out.motor_Nm = place.motor_share * demand.motor_N * radius_m;
  out.brake_Nm = friction_N * radius_m * fade(rim_m_s);
  at.assist_N -= place.motor_share * demand.motor_N - friction_N * fade(at.speed_m_s);
  find_suspension(state, i, at);
  if (is_flat()) return;
  const double share = place.static_load_N / layout_.rolling_load_N;
  const double roller_m_s = matter_.getMobilizedBody(bodies_.wheels[i].roller).getOneU(state, 0) * roller_radius_m_;
  const double set_N = share * fade(roller_m_s) * models::calc_road_load_N(layout_.resistance, roller_m_s);
  const double own_N = fade(roller_m_s) * models::calc_parasitic_N(context_.parasitic, std::abs(roller_m_s));
  const double keep_pace_N =
      bodies_.wheels[i].roller_mass_kg * kSynchronousBandwidth_rad_s * (at.speed_m_s - roller_m_s);
  out.roller_Nm = (own_N - set_N + keep_pace_N) * roller_radius_m_;
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
    at.wheels[i].roller_Nm += (share * all_N - hub_N(i)) * roller_radius_m_;
  }
}

void VehicleDrive::evaluate(const State& state, DriveEvaluation& at) const {
  at = {};
  at.wheels.resize(bodies_.wheels.size());
  models::Instant<double> now;
  now.recorded = program_inputs(state.getTime());
  now.recorded.load_N = layout_.wheels.front().static_load_N;
  bodies_.wheels.front().contact->apply_inputs(state, now);
  at.acting = now.acting;
  find_speed(state, at);
  find_demand(state, at);
  const models::ForceDemand<double> demand =
      driver_on_ && models::is_held(at.acting)
          ? models::ForceDemand<double>{at.demand_N, 0.0}
          : models::blend_brakes(at.demand_N, layout_.motor_limit_N, at.speed_m_s, layout_.regeneration_fade_m_s);
  at.motor_N = demand.motor_N;
  at.assist_N = demand.motor_N - demand.friction_N * fade(at.speed_m_s);  // less what the own wheels do
  for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) find_wheel(state, i, demand, at);
  share_restraint(at);
  if (is_flat()) {
    at.drag_N = calc_body_drag_N(at.speed_m_s, at.acting);
    at.grade_N = models::calc_grade_N(layout_.mass_kg, at.acting.slope);
  } else if (bodies_.sled.isValid()) {
    share_among_rollers(at);
    const SimTK::MobilizedBody& sled = matter_.getMobilizedBody(bodies_.sled);
    at.tie_down_N = -tie_down_.stiffness_N_per_m * sled.getOneQ(state, 0);
    at.tie_down_damper_N = -tie_down_.damping_N_s_per_m * sled.getOneU(state, 0);
  }
}

models::InputPort<double> VehicleDrive::find_recorded(const State& state, std::size_t i) const {
  models::InputPort<double> recorded = program_inputs(state.getTime());
  const DriveEvaluation& at = evaluation(state);
  const double radius_m = at.wheels[i].radius_m;
  recorded.load_N = layout_.wheels[i].static_load_N;
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

void VehicleDrive::realizeTopology(State& state) const {
  integral_z_ = forces_.allocateZ(state, SimTK::Vector(1, 0.0));
  cache_ = forces_.allocateLazyCacheEntry(state, SimTK::Stage::Velocity, new SimTK::Value<DriveEvaluation>());
}

void VehicleDrive::calcForce(const State& state, SimTK::Vector_<SpatialVec>& body_forces, SimTK::Vector_<Vec3>&,
                             SimTK::Vector& mobility_forces) const {
  const DriveEvaluation& at = evaluation(state);
  const Vec3 up(0, 1, 0);
  double along_N = -at.drag_N - at.grade_N + (is_flat() ? at.assist_N : 0.0);
  along_N += at.tie_down_N + at.tie_down_damper_N;
  body_forces[bodies_.body][1] += Vec3(along_N, 0, 0);
  for (std::size_t i = 0; i < bodies_.wheels.size(); ++i) {
    const DriveEvaluation::Wheel& wheel = at.wheels[i];
    const Wheel& own = bodies_.wheels[i];
    const SimTK::MobilizedBody& upright = matter_.getMobilizedBody(own.upright);
    upright.applyOneMobilityForce(state, 0, -(wheel.suspension_N + wheel.suspension_damper_N), mobility_forces);
    const double hub_Nm = wheel.motor_Nm - wheel.brake_Nm;  // about the wheel's own axis, the ground's -z
    body_forces[own.wheel][0] += Vec3(0, 0, -hub_Nm);
    body_forces[own.upright][0] += Vec3(0, 0, hub_Nm);
    const Vec3 arm_m(layout_.wheels[i].axle_x_m, 0, 0);
    body_forces[own.upright][1] -= wheel.on_upright_N * up;
    const Vec3 down_N = -(wheel.on_body_N + own.ballast_N) * up;
    body_forces[bodies_.body] += SpatialVec(SimTK::cross(arm_m, down_N), down_N);
    if (is_flat()) continue;
    const double assist_Nm = at.assist_N * roller_radius_m_ / static_cast<double>(bodies_.wheels.size());
    body_forces[own.roller][0] += Vec3(0, 0, wheel.roller_Nm + assist_Nm);
  }
}

void VehicleDrive::realizeAcceleration(const State& state) const {
  forces_.updZDot(state)[integral_z_] = evaluation(state).speed_error_m_s;
}

SimTK::Real VehicleDrive::calcPotentialEnergy(const State& state) const {
  double energy_J = 0.0;
  for (const Wheel& wheel : bodies_.wheels) {
    const double q_m = matter_.getMobilizedBody(wheel.upright).getOneQ(state, 0);
    energy_J += wheel.preload_N * q_m + 0.5 * suspension_.stiffness_N_per_m * q_m * q_m;
  }
  if (!is_flat() && bodies_.sled.isValid()) {
    const double x_m = matter_.getMobilizedBody(bodies_.sled).getOneQ(state, 0);
    energy_J += 0.5 * tie_down_.stiffness_N_per_m * x_m * x_m;
  }
  return energy_J;
}

}  // namespace rollrig::rigs
