#pragma once
/// Everything that perturbations a multibody vehicle but its tires: driver, motor, brakes, rollers, drag, suspension
/// and tie-downs, as one force element of Simbody.

#include <Simbody.h>

#include <vector>

#include "models/contact_force_element.h"
#include "models/vehicle/vehicle.h"
#include "rigs/vehicle_layout.h"

namespace rollrig::rigs {

/// What the drive does at one state.
struct DriveEvaluation {
  models::InputPort<double> acting;  // on the first wheel
  double speed_m_s = 0.0;            // of the rollers on a dynamometer, of the body on the flat
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
class VehicleDrive : public SimTK::Force::Custom::Implementation {
 public:
  struct Wheel {
    const models::ContactForceElement* contact = nullptr;
    SimTK::MobilizedBodyIndex wheel;
    SimTK::MobilizedBodyIndex upright;
    SimTK::MobilizedBodyIndex roller;  // invalid on the flat
    double roller_mass_kg = 0.0;       // inertia over R^2
    double preload_N = 0.0;            // of the suspension at its middle
    double ballast_N = 0.0;            // weight without inertia, on the body over this wheel
  };
  struct Bodies {
    SimTK::MobilizedBodyIndex body;
    SimTK::MobilizedBodyIndex sled;  // moves along the road under the body; invalid where it cannot
    std::vector<Wheel> wheels;
  };

  VehicleDrive(const SimTK::GeneralForceSubsystem& forces, const SimTK::SimbodyMatterSubsystem& matter, Bodies bodies,
               const VehicleLayout& layout, const VehicleFile& vehicle, const RigFile& rig,
               const models::Context<double>& context);

  void set_driver(bool on) { driver_on_ = on; }
  bool driver_on() const { return driver_on_; }
  SimTK::ZIndex integral_z() const { return integral_z_; }
  /// Integral at which the driver asks for a force at steady speed.
  double find_integral_m(double force_N, const models::InputPort<double>& acting) const;

  /// What the vehicle's program gives at a state's time, without forces; set before the first use.
  std::function<models::InputPort<double>(double time_s)> program_inputs;
  /// Inputs of one wheel with its longitudinal and brake force, as the contact element asks for them.
  models::InputPort<double> find_recorded(const SimTK::State& state, std::size_t wheel) const;

  /// At a state realized to Velocity.
  const DriveEvaluation& evaluation(const SimTK::State& state) const;

  void realizeTopology(SimTK::State& state) const override;
  void realizeAcceleration(const SimTK::State& state) const override;
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces, SimTK::Vector& mobility_forces) const override;
  /// Springs of suspension and tie-down.
  SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override;

 private:
  bool is_flat() const { return layout_.rig_kind == RigKind::kFlat; }
  void evaluate(const SimTK::State& state, DriveEvaluation& at) const;
  void find_speed(const SimTK::State& state, DriveEvaluation& at) const;
  void find_demand(const SimTK::State& state, DriveEvaluation& at) const;
  void find_wheel(const SimTK::State& state, std::size_t i, const models::ForceDemand<double>& demand,
                  DriveEvaluation& at) const;
  double find_restraint_N(const SimTK::State& state, std::size_t i, const DriveEvaluation& at) const;
  void share_restraint(DriveEvaluation& at) const;
  void share_among_rollers(DriveEvaluation& at) const;
  void find_suspension(const SimTK::State& state, std::size_t i, DriveEvaluation& at) const;
  double calc_feedforward_N(const models::InputPort<double>& acting) const;
  double calc_body_drag_N(double speed_m_s, const models::InputPort<double>& acting) const;

  const SimTK::GeneralForceSubsystem& forces_;
  const SimTK::SimbodyMatterSubsystem& matter_;
  Bodies bodies_;
  VehicleLayout layout_;
  VehicleSuspension suspension_;
  TieDownParameters tie_down_;
  double bandwidth_rad_s_;
  double roller_radius_m_;
  const models::Context<double>& context_;
  double total_mass_kg_;
  bool driver_on_ = true;
  mutable SimTK::ZIndex integral_z_;
  mutable SimTK::CacheEntryIndex cache_;
};

}  // namespace rollrig::rigs
