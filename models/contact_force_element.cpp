#include "models/contact_force_element.h"

#include "models/wheel/rolling_wheel.h"

namespace rollrig::models {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;

ContactForceElement::ContactForceElement(const SimTK::GeneralForceSubsystem& forces,
                                         const SimTK::SimbodyMatterSubsystem& matter, Bodies bodies,
                                         const Corner<double>& corner, InputSource inputs)
    : forces_(forces), matter_(matter), bodies_(bodies), corner_(corner), inputs_(std::move(inputs)) {
  update_contact_parameters(0.0);
}

void ContactForceElement::update_contact_parameters(double slip_compliance_per_N) {
  contact_ = make_contact_parameters(corner_.context().tire, slip_compliance_per_N);
}

void ContactForceElement::realizeTopology(State& state) const {
  first_z_ = forces_.allocateZ(state, SimTK::Vector(static_cast<int>(state_count()), 0.0));
  cache_ = forces_.allocateCacheEntry(state, SimTK::Stage::Dynamics, new SimTK::Value<ContactEvaluation>());
}

const double* ContactForceElement::z_of(const State& state) const { return &forces_.getZ(state)[first_z_]; }

ContactEvaluation& ContactForceElement::upd_evaluation(const State& state) const {
  return SimTK::Value<ContactEvaluation>::updDowncast(forces_.updCacheEntry(state, cache_)).upd();
}

const ContactEvaluation& ContactForceElement::evaluation(const State& state) const {
  return SimTK::Value<ContactEvaluation>::downcast(forces_.getCacheEntry(state, cache_)).get();
}

void ContactForceElement::evaluate_inputs(const State& state, Instant<double>& now) const {
  now.recorded = inputs_(state);
  apply_inputs(state, now);
}

void ContactForceElement::apply_inputs(const State& state, Instant<double>& now) const {
  now.inflation = inflation_;
  corner_.apply_inputs(z_of(state) + 1, now);
}

/// Where the tire touches, and the directions there.
void ContactForceElement::find_surface(const Vec3& wheel_center_m, const Vec3& surface_origin_m,
                                       ContactEvaluation& out) const {
  const double curvature_per_m = corner_.context().surface_curvature_per_m;
  const Vec3 between_m = wheel_center_m - surface_origin_m;
  out.axis = Vec3(0, 0, 1);
  if (curvature_per_m == 0.0) {
    out.normal = Vec3(0, 1, 0);
    out.loaded_radius_m = between_m[1];
    out.contact_point_m = wheel_center_m - out.loaded_radius_m * out.normal;
  } else {
    const double radius_m = 1.0 / curvature_per_m;
    const double distance_m = between_m.norm();
    out.normal = between_m / distance_m;
    out.loaded_radius_m = distance_m - radius_m;
    out.contact_point_m = surface_origin_m + radius_m * out.normal;
  }
  out.tangent = SimTK::cross(out.axis, out.normal);
}

void ContactForceElement::find_geometry(const State& state, ContactEvaluation& out) const {
  const SimTK::MobilizedBody& wheel = matter_.getMobilizedBody(bodies_.wheel);
  const SimTK::MobilizedBody& surface = matter_.getMobilizedBody(bodies_.surface);
  const Vec3& drum_center_m = surface.getBodyOriginLocation(state);
  find_surface(wheel.getBodyOriginLocation(state), drum_center_m, out);
  out.deflection_m = corner_.context().tire.geometry.outer_diameter_m / 2.0 - out.loaded_radius_m;

  const SpatialVec& wheel_velocity = wheel.getBodyVelocity(state);
  const SpatialVec& surface_velocity = surface.getBodyVelocity(state);
  out.surface_speed_rad_s = SimTK::dot(surface_velocity[0], out.axis);
  out.wheel_speed_rad_s = -SimTK::dot(wheel_velocity[0], out.axis);
  const Vec3 surface_point_m_s =
      surface_velocity[1] + SimTK::cross(surface_velocity[0], out.contact_point_m - drum_center_m);
  const Vec3 past_wheel_m_s = surface_point_m_s - wheel_velocity[1];
  out.now.motion.speed_m_s = SimTK::dot(past_wheel_m_s, out.tangent);
  out.deflection_rate_m_s = SimTK::dot(past_wheel_m_s, out.normal);
}

void ContactForceElement::evaluate(const State& state, ContactEvaluation& out) const {
  const double* z = z_of(state);
  const double* x = z + 1;
  out.corner_rates.resize(corner_.state_count());
  evaluate_inputs(state, out.now);
  find_geometry(state, out);
  Motion<double>& motion = out.now.motion;
  motion.acceleration_m_s2 = out.now.acting.acceleration_m_s2;
  out.normal_N = calc_normal_force_N(contact_, out.deflection_m, out.deflection_rate_m_s);
  motion.load_N = out.normal_N;
  const double slip_speed_m_s = motion.speed_m_s - out.wheel_speed_rad_s * out.loaded_radius_m;
  out.slip = calc_slip_force(contact_, motion.speed_m_s, slip_speed_m_s, out.normal_N, z[0]);
  motion.longitudinal_force_N = out.slip.force_N;
  motion.slip_power_W = out.slip.dissipated_W;
  const double curvature_per_m = corner_.context().surface_curvature_per_m;
  motion.rolling_speed_m_s = (out.wheel_speed_rad_s + out.surface_speed_rad_s) * out.loaded_radius_m /
                             calc_rolling_ratio(out.loaded_radius_m, curvature_per_m);
  corner_.calc_losses(x, out.now);
  corner_.calc_rates(x, out.now, out.corner_rates.data());
  out.couple_Nm = calc_resistance_couple_Nm(out.now.rolling_resistance_N, out.loaded_radius_m, curvature_per_m);
}

void ContactForceElement::calcForce(const State& state, SimTK::Vector_<SpatialVec>& body_forces, SimTK::Vector_<Vec3>&,
                                    SimTK::Vector&) const {
  ContactEvaluation& at = upd_evaluation(state);
  evaluate(state, at);
  const Vec3 on_wheel_N = at.normal_N * at.normal + at.slip.force_N * at.tangent;
  const Vec3 couple_on_surface_Nm = -at.couple_Nm * at.axis;
  const Vec3& wheel_center_m = matter_.getMobilizedBody(bodies_.wheel).getBodyOriginLocation(state);
  const Vec3& drum_center_m = matter_.getMobilizedBody(bodies_.surface).getBodyOriginLocation(state);
  body_forces[bodies_.wheel] +=
      SpatialVec(SimTK::cross(at.contact_point_m - wheel_center_m, on_wheel_N) - couple_on_surface_Nm, on_wheel_N);
  body_forces[bodies_.surface] +=
      SpatialVec(SimTK::cross(at.contact_point_m - drum_center_m, -on_wheel_N) + couple_on_surface_Nm, -on_wheel_N);
  const double curvature_per_m = corner_.context().surface_curvature_per_m;
  if (curvature_per_m > 0.0) {
    body_forces[bodies_.surface][0] -= at.now.parasitic_N / curvature_per_m * at.axis;
  } else {
    const Vec3 on_hub_Nm = at.now.parasitic_N * at.loaded_radius_m * at.axis;  // the wheel turns about -axis
    body_forces[bodies_.wheel][0] += on_hub_Nm;
    body_forces[bodies_.carrier][0] -= on_hub_Nm;
  }
}

void ContactForceElement::realizeAcceleration(const State& state) const {
  const ContactEvaluation& at = evaluation(state);
  double* rates = &forces_.updZDot(state)[first_z_];
  rates[0] = at.slip.deflection_rate_m_s;
  std::copy(at.corner_rates.begin(), at.corner_rates.end(), rates + 1);
}

double ContactForceElement::calc_tire_spring_J(const ContactEvaluation& at) const {
  const double pressed_m = std::max(0.0, at.deflection_m);
  return 0.5 * contact_.vertical_N_per_m * pressed_m * pressed_m;
}

double ContactForceElement::calc_slip_spring_J(const State& state) const {
  const double deflection_m = z_of(state)[0];
  return 0.5 * contact_.slip_spring_N_per_m * deflection_m * deflection_m;
}

SimTK::Real ContactForceElement::calcPotentialEnergy(const State& state) const {
  ContactEvaluation at;
  evaluate(state, at);
  return calc_tire_spring_J(at) + calc_slip_spring_J(state);
}

}  // namespace rollrig::models
