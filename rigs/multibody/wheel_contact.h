#pragma once
/// Corner and contact law between bodies of Simbody. No equations of its own: it turns positions and velocities of
/// bodies into what models/ take, and what they give into forces and rates.

#include <Simbody.h>

#include <vector>

#include "models/contact_law.h"
#include "models/corner.h"

namespace rollrig::rigs {

/// Everything that is known of a contact at one state.
struct ContactEvaluation {
  models::Instant<double> now;
  std::vector<double> corner_rates;
  double deflection_m = 0.0;
  double deflection_rate_m_s = 0.0;
  double loaded_radius_m = 0.0;
  double normal_N = 0.0;
  models::SlipForce<double> slip;
  double couple_Nm = 0.0;
  double wheel_speed_rad_s = 0.0;
  double surface_speed_rad_s = 0.0;

  SimTK::Vec3 contact_point_m;
  SimTK::Vec3 normal;   // from the surface to the wheel
  SimTK::Vec3 tangent;  // in which the surface moves when its speed is positive
  SimTK::Vec3 axis;     // about which the surface then turns
};

/// The tire of one wheel on one surface: a drum or roller that turns about the ground's z axis, or, where the
/// corner's surface has no curvature, the plane y = 0 of the surface's body: the ground, or a belt on it.
///
/// Forces    on the wheel at the contact: Fz n + Fx t; on the surface the opposite; the couple
///           M of rolling resistance on both; the parasitic loss F_par as a torque on the drum or a force on
///           the belt, or on the road, where no surface has bearings, as a torque between the wheel and the body that
///           carries it
/// States    z: slip deflection, then the corner's states
class WheelContact {
 public:
  struct Bodies {
    SimTK::MobilizedBodyIndex wheel;
    SimTK::MobilizedBodyIndex surface;
    SimTK::MobilizedBodyIndex carrier;  // in which the wheel's bearing is
  };

  WheelContact(const SimTK::SimbodyMatterSubsystem& matter, Bodies bodies, const models::Corner<double>& corner,
               double slip_compliance_per_N);

  const models::Corner<double>& corner() const { return *corner_; }
  const models::TireParameters<double>& tire() const { return corner_->context().tire; }
  std::size_t state_count() const { return 1 + corner_->state_count(); }
  double slip_spring_N_per_m() const { return contact_.slip_spring_N_per_m; }

  /// State in which the tire was inflated; the caller invalidates the state's cache after a change.
  void set_inflation(const models::Inflation<double>& inflation) { inflation_ = inflation; }
  const models::Inflation<double>& inflation() const { return inflation_; }

  /// What really acts, from the inputs in now.recorded.
  void apply_inputs(const double* z, models::Instant<double>& now) const;
  /// All else, from the inputs in out.now.recorded, at a state realized to Velocity.
  void evaluate(const SimTK::State& state, const double* z, ContactEvaluation& out) const;
  void add_forces(const SimTK::State& state, const ContactEvaluation& at,
                  SimTK::Vector_<SimTK::SpatialVec>& body_forces) const;
  static void put_rates(const ContactEvaluation& at, double* z_rates);

  double calc_tire_spring_J(const ContactEvaluation& at) const;
  double calc_slip_spring_J(const double* z) const;
  double calc_tire_damper_W(const ContactEvaluation& at) const;

 private:
  void find_geometry(const SimTK::State& state, ContactEvaluation& out) const;
  void find_surface(const SimTK::Vec3& wheel_center_m, const SimTK::Vec3& surface_origin_m,
                    ContactEvaluation& out) const;

  const SimTK::SimbodyMatterSubsystem* matter_;
  Bodies bodies_;
  const models::Corner<double>* corner_;
  models::Inflation<double> inflation_;
  models::ContactParameters<double> contact_;
};

}  // namespace rollrig::rigs
