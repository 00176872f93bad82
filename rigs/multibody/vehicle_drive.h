#pragma once
/// Everything that drives a multibody vehicle or holds it back beside its tires: driver, motor, brakes, rollers, drag,
/// suspension and tie-downs.

#include <vector>

#include "models/vehicle/vehicle.h"
#include "rigs/multibody/rig_forces.h"
#include "rigs/multibody/vehicle_bodies.h"
#include "rigs/vehicle_channels.h"

namespace rollrig::rigs {

/// What the drive does at one state.
struct DriveEvaluation {
  models::InputPort<double> acting;  // on the first wheel
  double speed_m_s = 0.0;            // of the rollers on a dynamometer, of the body on the road
  double speed_error_m_s = 0.0;
  double demand_N = 0.0;
  double motor_N = 0.0;   // of the whole demand
  double assist_N = 0.0;  // of the rest of the vehicle
  double grade_N = 0.0;
  double drag_N = 0.0;  // of the body, road load included

  struct Wheel {
    double radius_m = 0.0;  // loaded, at rest
    double motor_Nm = 0.0;
    double brake_Nm = 0.0;   // against the wheel's turning
    double roller_Nm = 0.0;  // on the roller
    double suspension_N = 0.0;
    double suspension_damper_N = 0.0;
    double restraint_N = 0.0;   // on the contact beyond the wheel's share of the weight: of the tie-downs (effect
                                // tie_down_load), or not in the record (load_record)
    double on_body_N = 0.0;     // of it, downwards on the body: the mean of all wheels
    double on_upright_N = 0.0;  // downwards on the upright, for the rest, and for what the suspension gives in to it
  };
  std::vector<Wheel> wheels;
  double sinks_m = 0.0;     // of the body, by the restraint
  double tie_down_N = 0.0;  // along the vehicle
  double tie_down_damper_N = 0.0;
};

/// Driver    D = F_ff(v_set) + m (a_set + 2 w e + w^2 I), dI/dt = e, e = v_set - v: critically damped at w;
///           F_ff the rollers' force or drag, grade and a rolling loss of 1 % of the weight; coasting: D = 0
/// Brakes    D shared by blend_brakes, at a held standstill all of it the motor's; a friction brake's torque
///           fades with tanh(v_rim / 0.05 m/s)
/// Rollers   T_i = R (F_par(v_i) - s_i (A + B v_i + C v_i^2) + s_i sum D_j - D_i + w_s m_i (v - v_i)), v the mean by
///           inertia: each makes up for its own nominal bearings, bears its share s of the set force and of
///           what all hubs do, and keeps pace with the others
/// Source    (3.20), §3.4.2, §3.4.3. Assumed: gains, 20 rad/s for w_s
/// Checked   tests/rigs/multibody_vehicle_test.cpp
class VehicleDrive : public RigForces {
 public:
  /// `bodies`, `layout` and `present` outlive it.
  VehicleDrive(const SimTK::GeneralForceSubsystem& forces, std::vector<WheelContact> contacts,
               const VehicleBodies& bodies, const VehicleLayout& layout, const PresentProgram& present);

  double tire_N_per_m(std::size_t wheel) const { return contacts()[wheel].tire().stiffness.vertical_N_per_m; }
  SimTK::ZIndex integral_z() const { return own_z(); }
  /// Integral at which the driver asks for a force at steady speed.
  double find_integral_m(double force_N, const models::InputPort<double>& acting) const;

  /// At a state realized to Velocity.
  const DriveEvaluation& evaluation(const SimTK::State& state) const;

  /// What goes in and is lost but for tires and bearings, at a state realized to Velocity.
  VehiclePowers<double> find_powers(const SimTK::State& state) const;

  /// Suspension and tie-downs.
  double calc_own_springs_J(const SimTK::State& state) const override;

 private:
  models::InputPort<double> find_recorded(const SimTK::State& state, std::size_t wheel) const override;
  void add_own_forces(const SimTK::State& state, const Contacts& contacts,
                      SimTK::Vector_<SimTK::SpatialVec>& body_forces, SimTK::Vector& mobility_forces) const override;
  void put_own_rates(const SimTK::State& state, const Contacts& contacts, double* z_rates) const override;
  void allocate_own_caches(SimTK::State& state) const override;

  bool is_on_road() const { return models::is_on_road(layout_.machine); }
  /// What the vehicle's program gives for a wheel, without forces.
  models::InputPort<double> read_program(const SimTK::State& state, std::size_t wheel) const;
  void evaluate(const SimTK::State& state, DriveEvaluation& at) const;
  void find_speed(const SimTK::State& state, DriveEvaluation& at) const;
  void find_demand(const SimTK::State& state, DriveEvaluation& at) const;
  void find_wheel(const SimTK::State& state, std::size_t i, const models::ForceDemand<double>& demand,
                  DriveEvaluation& at) const;
  void share_restraint(DriveEvaluation& at) const;
  void share_among_rollers(DriveEvaluation& at) const;
  void find_suspension(const SimTK::State& state, std::size_t i, DriveEvaluation& at) const;
  double calc_feedforward_N(const models::InputPort<double>& acting) const;
  double calc_assist_Nm(const DriveEvaluation& at) const;
  double calc_given_W(const SimTK::State& state, std::size_t i) const;
  double calc_body_drag_N(double speed_m_s, const models::InputPort<double>& acting) const;

  const VehicleBodies& bodies_;
  const VehicleLayout& layout_;
  const PresentProgram& present_;
  double total_mass_kg_;
  mutable SimTK::CacheEntryIndex cache_;
};

}  // namespace rollrig::rigs
