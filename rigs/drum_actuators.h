#pragma once
/// Motor of the drum and load cylinder of the carriage, as one force element of Simbody.

#include <Simbody.h>

#include "models/contact_force_element.h"
#include "rigs/rig_file.h"

namespace rollrig::rigs {

/// What the actuators do at one state.
struct ActuatorEvaluation {
  double motor_torque_Nm = 0.0;
  double cylinder_force_N = 0.0;  // on the carriage, downwards
  double damper_force_N = 0.0;    // on the carriage, upwards
  double speed_error_rad_s = 0.0;
  double lag_rate_N_s = 0.0;
};

/// Motor     T = J_eff domega_set/dt + R F_par(v_set) + K_p e + K_i I,  dI/dt = e,  e = omega_set - omega;
///           K_p = 2 J_eff w, K_i = J_eff w^2: critically damped at the bandwidth w;
///           J_eff = J + I_spin (R/r_l)^2; F_par the rig's nominal parasitic loss; off: T = 0, I held
/// Cylinder  F = load asked for + e - weight of carriage and wheel, de/dt = -e/tau, so that the contact
///           comes to carry the load asked for; e [N] takes up each jump of it; damper c dz/dt
/// Source    Assumed: gains; the load and weight from statics
/// Checked   tests/rigs/multibody_drum_test.cpp
class DrumActuators : public SimTK::Force::Custom::Implementation {
 public:
  struct Bodies {
    SimTK::MobilizedBodyIndex drum;
    SimTK::MobilizedBodyIndex carriage;
    SimTK::MobilizedBodyIndex wheel;
  };

  DrumActuators(const SimTK::GeneralForceSubsystem& forces, const SimTK::SimbodyMatterSubsystem& matter, Bodies bodies,
                const RigFile& rig, const models::ContactForceElement& contact, const models::Context<double>& context);

  void set_motor(bool on) { motor_on_ = on; }
  bool motor_on() const { return motor_on_; }
  /// Auxiliary states: integral of the speed error, then the cylinder's lag e.
  SimTK::ZIndex integral_z() const { return integral_z_; }
  SimTK::ZIndex lag_z() const { return SimTK::ZIndex(integral_z_ + 1); }
  /// Integral of the speed error at which the motor gives a torque at constant speed.
  double find_integral_rad(double torque_Nm, double speed_m_s, double load_N) const;

  /// At a state realized to Velocity; `acting` are the inputs that really act.
  ActuatorEvaluation evaluate(const SimTK::State& state, const models::InputPort<double>& acting) const;

  void realizeTopology(SimTK::State& state) const override;
  void realizeAcceleration(const SimTK::State& state) const override;
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces, SimTK::Vector& mobility_forces) const override;
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  double calc_effective_inertia_kg_m2(double load_N) const;
  double calc_friction_feedforward_Nm(double speed_m_s) const;
  double drum_speed_rad_s(const SimTK::State& state) const;

  const SimTK::GeneralForceSubsystem& forces_;
  const SimTK::SimbodyMatterSubsystem& matter_;
  Bodies bodies_;
  double radius_m_;
  double inertia_kg_m2_;
  double bandwidth_rad_s_;
  double damping_N_s_per_m_;
  double load_time_constant_s_;
  double weight_N_;
  const models::ContactForceElement& contact_;
  const models::Context<double>& context_;
  bool motor_on_ = true;
  mutable SimTK::ZIndex integral_z_;
};

}  // namespace rollrig::rigs
