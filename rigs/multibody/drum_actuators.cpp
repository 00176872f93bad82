#include "rigs/multibody/drum_actuators.h"

namespace rollrig::rigs {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;

DrumActuators::DrumActuators(const SimTK::GeneralForceSubsystem& forces, WheelContact contact, Bodies bodies,
                             const RigFile& rig, const PresentProgram& present)
    : RigForces(forces, {contact}, 2),
      bodies_(bodies),
      is_belt_(!rig.is_curved()),
      radius_m_(rig.lever_m()),
      inertia_kg_m2_(rig.inertia()),
      bandwidth_rad_s_(rig.drive.bandwidth_rad_s),
      damping_N_s_per_m_(rig.carriage.damping_N_s_per_m),
      load_time_constant_s_(rig.carriage.load_time_constant_s),
      weight_N_(kStandardGravity_m_s2 *
                (rig.carriage.mass_kg + contact.tire().geometry.mass_kg + contact.tire().geometry.wheel_mass_kg)),
      context_(contact.corner().context()),
      present_(present) {}

double DrumActuators::calc_effective_inertia_kg_m2(double load_N) const {
  const double loaded_radius_m = calc_loaded_radius_m(context_.tire, load_N);
  return inertia_kg_m2_ + calc_spin_mass_kg(context_.tire, loaded_radius_m) * radius_m_ * radius_m_;
}

double DrumActuators::calc_friction_feedforward_Nm(double speed_m_s) const {
  return radius_m_ * models::calc_faded_parasitic_N(context_.parasitic, speed_m_s);
}

double DrumActuators::find_integral_rad(double torque_Nm, double speed_m_s, double load_N) const {
  return (torque_Nm - calc_friction_feedforward_Nm(speed_m_s)) /
         (calc_effective_inertia_kg_m2(load_N) * bandwidth_rad_s_ * bandwidth_rad_s_);
}

models::InputPort<double> DrumActuators::find_recorded(const State& state, std::size_t) const {
  return read_drum_inputs<double>(present_, state.getTime());
}

models::InputPort<double> DrumActuators::find_acting(const State& state) const {
  return RigForces::find_acting(state, 0, find_recorded(state, 0));
}

ActuatorEvaluation DrumActuators::evaluate(const State& state, const models::InputPort<double>& acting) const {
  ActuatorEvaluation at;
  const double* z = own_states(state);
  at.cylinder_force_N = acting.load_N + z[1] - weight_N_;
  at.lag_rate_N_s = -z[1] / load_time_constant_s_;
  at.damper_force_N = -damping_N_s_per_m_ * bodies_.carriage.getOneU(state, 0);
  if (!present_.drive_on) return at;
  const double inertia_kg_m2 = calc_effective_inertia_kg_m2(acting.load_N);
  at.speed_error_rad_s = acting.speed_m_s / radius_m_ - bodies_.drum.getOneU(state, 0);
  at.motor_torque_Nm =
      calc_friction_feedforward_Nm(acting.speed_m_s) +
      inertia_kg_m2 * (acting.acceleration_m_s2 / radius_m_ + 2.0 * bandwidth_rad_s_ * at.speed_error_rad_s +
                       bandwidth_rad_s_ * bandwidth_rad_s_ * z[0]);
  return at;
}

void DrumActuators::add_own_forces(const State& state, const Contacts& contacts,
                                   SimTK::Vector_<SpatialVec>& body_forces, SimTK::Vector&) const {
  const ActuatorEvaluation at = evaluate(state, contacts.front().now.acting);
  body_forces[bodies_.drum.getMobilizedBodyIndex()] += is_belt_ ? SpatialVec(Vec3(0), Vec3(-at.motor_torque_Nm, 0, 0))
                                                                : SpatialVec(Vec3(0, 0, at.motor_torque_Nm), Vec3(0));
  body_forces[bodies_.carriage.getMobilizedBodyIndex()] +=
      SpatialVec(Vec3(0), Vec3(0, at.damper_force_N - at.cylinder_force_N, 0));
}

void DrumActuators::put_own_rates(const State& state, const Contacts& contacts, double* z_rates) const {
  const ActuatorEvaluation at = evaluate(state, contacts.front().now.acting);
  z_rates[0] = at.speed_error_rad_s;
  z_rates[1] = at.lag_rate_N_s;
}

}  // namespace rollrig::rigs
