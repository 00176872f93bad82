#pragma once
/// Corner and contact law as a force element of Simbody. No equations of its own: it turns positions and
/// velocities of bodies into what models/ take, and what they give into forces and rates.

#include <functional>
#include <optional>

#include <Simbody.h>

#include "models/contact_law.h"
#include "models/corner.h"

namespace rollrig::models {

/// Recorded inputs at a state, realized to Velocity where the source needs it.
using InputSource = std::function<InputPort<double>(const SimTK::State& state)>;

/// Everything that the element knows at one state.
struct ContactEvaluation {
  Instant<double> now;
  std::vector<double> corner_rates;
  double deflection_m = 0.0;
  double deflection_rate_m_s = 0.0;
  double loaded_radius_m = 0.0;
  double normal_N = 0.0;
  SlipForce<double> slip;
  double couple_Nm = 0.0;
  double wheel_speed_rad_s = 0.0;
  double surface_speed_rad_s = 0.0;

  SimTK::Vec3 contact_point_m;
  SimTK::Vec3 normal;   // from the surface to the wheel
  SimTK::Vec3 tangent;  // in which the surface moves when its speed is positive
  SimTK::Vec3 axis;     // about which the surface then turns
};

/// The tire of one wheel on one surface: a drum or roller that turns about the ground's z axis, or, where the
/// corner's surface has no curvature, the plane y = 0 of the surface's body.
///
/// Forces    on the wheel at the contact: Fz n + Fx t; on the surface the opposite; the couple
///           M of rolling resistance on both; the parasitic loss F_par as a torque on the drum, or on the flat,
///           where no drum has bearings, as a torque between the wheel and the body that carries it
/// States    slip deflection, then the corner's states (auxiliary variables z of the force subsystem)
/// Energy    calcPotentialEnergy: tire and slip spring
class ContactForceElement : public SimTK::Force::Custom::Implementation {
 public:
  struct Bodies {
    SimTK::MobilizedBodyIndex wheel;
    SimTK::MobilizedBodyIndex surface;
    SimTK::MobilizedBodyIndex carrier;  // in which the wheel's bearing is
  };

  ContactForceElement(const SimTK::GeneralForceSubsystem& forces, const SimTK::SimbodyMatterSubsystem& matter,
                      Bodies bodies, const Corner<double>& corner, InputSource inputs);

  /// State in which the tire was inflated; the caller invalidates the state's cache after a change.
  void set_inflation(const Inflation<double>& inflation) { inflation_ = inflation; }
  const Inflation<double>& inflation() const { return inflation_; }
  /// To be called when the corner's parameters changed.
  void update_contact_parameters(double slip_compliance_per_N);

  std::size_t state_count() const { return 1 + corner_.state_count(); }
  /// Index of the slip deflection among the subsystem's z; the corner's states follow it.
  SimTK::ZIndex first_z() const { return first_z_; }

  /// Everything at a state realized to Velocity.
  void evaluate(const SimTK::State& state, ContactEvaluation& out) const;
  /// What evaluate() gave when this state was last realized to Dynamics.
  const ContactEvaluation& evaluation(const SimTK::State& state) const;
  /// Inputs that really act at the state's time, for the actuators; needs what the input source needs.
  void evaluate_inputs(const SimTK::State& state, Instant<double>& now) const;
  /// The same for inputs that the caller has put into now.recorded; needs no stage.
  void apply_inputs(const SimTK::State& state, Instant<double>& now) const;
  double calc_tire_spring_J(const ContactEvaluation& at) const;
  double calc_slip_spring_J(const SimTK::State& state) const;

  void realizeTopology(SimTK::State& state) const override;
  void realizeAcceleration(const SimTK::State& state) const override;
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces, SimTK::Vector& mobility_forces) const override;
  SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override;

 private:
  void find_geometry(const SimTK::State& state, ContactEvaluation& out) const;
  void find_surface(const SimTK::Vec3& wheel_center_m, const SimTK::Vec3& surface_origin_m,
                    ContactEvaluation& out) const;
  const double* z_of(const SimTK::State& state) const;
  ContactEvaluation& upd_evaluation(const SimTK::State& state) const;

  const SimTK::GeneralForceSubsystem& forces_;
  const SimTK::SimbodyMatterSubsystem& matter_;
  Bodies bodies_;
  const Corner<double>& corner_;
  InputSource inputs_;
  Inflation<double> inflation_;
  ContactParameters<double> contact_;
  mutable SimTK::ZIndex first_z_;
  mutable SimTK::CacheEntryIndex cache_;
};

}  // namespace rollrig::models
