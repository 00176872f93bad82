#include "rigs/drum_actuators.h"

#include <cmath>

namespace rollrig::rigs {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;

DrumActuators::DrumActuators(const SimTK::GeneralForceSubsystem& forces, const SimTK::SimbodyMatterSubsystem& matter,
                             Bodies bodies, const RigFile& rig, const models::ContactForceElement& contact,
                             const models::Context<double>& context)
    : forces_(forces),
      matter_(matter),
      bodies_(bodies),
      radius_m_(rig.drum.diameter_m / 2.0),
      inertia_kg_m2_(rig.drum.inertia_kg_m2),
      bandwidth_rad_s_(rig.drive.bandwidth_rad_s),
      damping_N_s_per_m_(rig.carriage.damping_N_s_per_m),
      load_time_constant_s_(rig.carriage.load_time_constant_s),
      weight_N_(kStandardGravity_m_s2 *
                (rig.carriage.mass_kg + context.tire.geometry.mass_kg + context.tire.geometry.wheel_mass_kg)),
      contact_(contact),
      context_(context) {}

double DrumActuators::calc_effective_inertia_kg_m2(double load_N) const {
  const double ratio = radius_m_ / calc_loaded_radius_m(context_.tire, load_N);
  return inertia_kg_m2_ + context_.tire.geometry.spin_inertia_kg_m2 * ratio * ratio;
}

double DrumActuators::calc_friction_feedforward_Nm(double speed_m_s) const {
  return radius_m_ * models::calc_standstill_fade(speed_m_s) *
         models::calc_parasitic_N(context_.parasitic, std::abs(speed_m_s));
}

double DrumActuators::find_integral_rad(double torque_Nm, double speed_m_s, double load_N) const {
  return (torque_Nm - calc_friction_feedforward_Nm(speed_m_s)) /
         (calc_effective_inertia_kg_m2(load_N) * bandwidth_rad_s_ * bandwidth_rad_s_);
}

double DrumActuators::drum_speed_rad_s(const State& state) const {
  return matter_.getMobilizedBody(bodies_.drum).getOneU(state, 0);
}

ActuatorEvaluation DrumActuators::evaluate(const State& state, const models::InputPort<double>& acting) const {
  ActuatorEvaluation at;
  const double lag_N = forces_.getZ(state)[lag_z()];
  at.cylinder_force_N = acting.load_N + lag_N - weight_N_;
  at.lag_rate_N_s = -lag_N / load_time_constant_s_;
  at.damper_force_N = -damping_N_s_per_m_ * matter_.getMobilizedBody(bodies_.carriage).getOneU(state, 0);
  if (!motor_on_) return at;
  const double inertia_kg_m2 = calc_effective_inertia_kg_m2(acting.load_N);
  at.speed_error_rad_s = acting.speed_m_s / radius_m_ - drum_speed_rad_s(state);
  const double integral_rad = forces_.getZ(state)[integral_z_];
  at.motor_torque_Nm =
      calc_friction_feedforward_Nm(acting.speed_m_s) +
      inertia_kg_m2 * (acting.acceleration_m_s2 / radius_m_ + 2.0 * bandwidth_rad_s_ * at.speed_error_rad_s +
                       bandwidth_rad_s_ * bandwidth_rad_s_ * integral_rad);
  return at;
}

void DrumActuators::realizeTopology(State& state) const {
  integral_z_ = forces_.allocateZ(state, SimTK::Vector(2, 0.0));
}

void DrumActuators::calcForce(const State& state, SimTK::Vector_<SpatialVec>& body_forces, SimTK::Vector_<Vec3>&,
                              SimTK::Vector&) const {
  models::Instant<double> now;
  contact_.evaluate_inputs(state, now);
  const ActuatorEvaluation at = evaluate(state, now.acting);
  body_forces[bodies_.drum] += SpatialVec(Vec3(0, 0, at.motor_torque_Nm), Vec3(0));
  body_forces[bodies_.carriage] += SpatialVec(Vec3(0), Vec3(0, at.damper_force_N - at.cylinder_force_N, 0));
}

void DrumActuators::realizeAcceleration(const State& state) const {
  models::Instant<double> now;
  contact_.evaluate_inputs(state, now);
  const ActuatorEvaluation at = evaluate(state, now.acting);
  forces_.updZDot(state)[integral_z_] = at.speed_error_rad_s;
  forces_.updZDot(state)[lag_z()] = at.lag_rate_N_s;
}

}  // namespace rollrig::rigs
