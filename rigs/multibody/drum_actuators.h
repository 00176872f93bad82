#pragma once
/// Motor of the drum or belt and load cylinder of the carriage, with the wheel that they press on the drum.

#include "rigs/drum_channels.h"
#include "rigs/multibody/rig_forces.h"
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
///           J_eff = J + I_spin (R/r_l)^2; of a belt R = 1 and T is the force on it, towards -x; F_par the rig's
///           nominal parasitic loss; off: T = 0, I held
/// Cylinder  F = load asked for + e - weight of carriage and wheel, de/dt = -e/tau, so that the contact
///           comes to carry the load asked for; e [N] takes up each jump of it; damper c dz/dt
/// Source    Assumed: gains; the load and weight from statics
/// Checked   tests/rigs/multibody_drum_test.cpp
class DrumActuators : public RigForces {
 public:
  struct Bodies {
    SimTK::MobilizedBody drum;  // or belt
    SimTK::MobilizedBody carriage;
  };

  DrumActuators(const SimTK::GeneralForceSubsystem& forces, WheelContact contact, Bodies bodies, const RigFile& rig,
                const PresentProgram& present);

  /// Own states: integral of the speed error, then the cylinder's lag e.
  SimTK::ZIndex integral_z() const { return own_z(); }
  /// Integral of the speed error at which the motor gives a torque at constant speed.
  double find_integral_rad(double torque_Nm, double speed_m_s, double load_N) const;

  /// Inputs that really act, at the present time of a state.
  models::InputPort<double> find_acting(const SimTK::State& state) const;
  /// At a state realized to Velocity; `acting` are the inputs that really act.
  ActuatorEvaluation evaluate(const SimTK::State& state, const models::InputPort<double>& acting) const;

 private:
  models::InputPort<double> find_recorded(const SimTK::State& state, std::size_t wheel) const override;
  void add_own_forces(const SimTK::State& state, const Contacts& contacts,
                      SimTK::Vector_<SimTK::SpatialVec>& body_forces, SimTK::Vector& mobility_forces) const override;
  void put_own_rates(const SimTK::State& state, const Contacts& contacts, double* z_rates) const override;
  double calc_effective_inertia_kg_m2(double load_N) const;
  double calc_friction_feedforward_Nm(double speed_m_s) const;

  Bodies bodies_;
  bool is_belt_;
  double radius_m_;
  double inertia_kg_m2_;
  double bandwidth_rad_s_;
  double damping_N_s_per_m_;
  double load_time_constant_s_;
  double weight_N_;
  const models::Context<double>& context_;
  const PresentProgram& present_;
};

}  // namespace rollrig::rigs
