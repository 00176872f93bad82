#include "rigs/multibody/wheel_contact.h"

#include <algorithm>

#include "models/wheel/rolling_wheel.h"

namespace rollrig::rigs {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;

WheelContact::WheelContact(const SimTK::SimbodyMatterSubsystem& matter, Bodies bodies,
                           const models::Corner<double>& corner, double slip_compliance_per_N)
    : matter_(&matter),
      bodies_(bodies),
      corner_(&corner),
      contact_(models::make_contact_parameters(corner.context().tire, slip_compliance_per_N)) {}

void WheelContact::apply_inputs(const double* z, models::Instant<double>& now) const {
  now.inflation = inflation_;
  corner_->apply_inputs(z + 1, now);
}

/// Where the tire touches, and the directions there.
void WheelContact::find_surface(const Vec3& wheel_center_m, const Vec3& surface_origin_m,
                                ContactEvaluation& out) const {
  const double curvature_per_m = corner_->context().surface_curvature_per_m;
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

void WheelContact::find_geometry(const State& state, ContactEvaluation& out) const {
  const SimTK::MobilizedBody& wheel = matter_->getMobilizedBody(bodies_.wheel);
  const SimTK::MobilizedBody& surface = matter_->getMobilizedBody(bodies_.surface);
  const Vec3& drum_center_m = surface.getBodyOriginLocation(state);
  find_surface(wheel.getBodyOriginLocation(state), drum_center_m, out);
  out.deflection_m = corner_->context().tire.geometry.outer_diameter_m / 2.0 - out.loaded_radius_m;

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

void WheelContact::evaluate(const State& state, const double* z, ContactEvaluation& out) const {
  const double* x = z + 1;
  out.corner_rates.resize(corner_->state_count());
  apply_inputs(z, out.now);
  find_geometry(state, out);
  models::Motion<double>& motion = out.now.motion;
  motion.acceleration_m_s2 = out.now.acting.acceleration_m_s2;
  out.normal_N = models::calc_normal_force_N(contact_, out.deflection_m, out.deflection_rate_m_s);
  motion.load_N = out.normal_N;
  const double slip_speed_m_s = motion.speed_m_s - out.wheel_speed_rad_s * out.loaded_radius_m;
  out.slip = models::calc_slip_force(contact_, motion.speed_m_s, slip_speed_m_s, out.normal_N, z[0]);
  motion.longitudinal_force_N = out.slip.force_N;
  motion.slip_power_W = out.slip.dissipated_W;
  const double curvature_per_m = corner_->context().surface_curvature_per_m;
  motion.rolling_speed_m_s = (out.wheel_speed_rad_s + out.surface_speed_rad_s) * out.loaded_radius_m /
                             models::calc_rolling_ratio(out.loaded_radius_m, curvature_per_m);
  corner_->calc_losses(x, out.now);
  corner_->calc_rates(x, out.now, out.corner_rates.data());
  out.couple_Nm = models::calc_resistance_couple_Nm(out.now.rolling_resistance_N, out.loaded_radius_m, curvature_per_m);
}

void WheelContact::add_forces(const State& state, const ContactEvaluation& at,
                              SimTK::Vector_<SpatialVec>& body_forces) const {
  const Vec3 on_wheel_N = at.normal_N * at.normal + at.slip.force_N * at.tangent;
  const Vec3 couple_on_surface_Nm = -at.couple_Nm * at.axis;
  const Vec3& wheel_center_m = matter_->getMobilizedBody(bodies_.wheel).getBodyOriginLocation(state);
  const Vec3& drum_center_m = matter_->getMobilizedBody(bodies_.surface).getBodyOriginLocation(state);
  body_forces[bodies_.wheel] +=
      SpatialVec(SimTK::cross(at.contact_point_m - wheel_center_m, on_wheel_N) - couple_on_surface_Nm, on_wheel_N);
  body_forces[bodies_.surface] +=
      SpatialVec(SimTK::cross(at.contact_point_m - drum_center_m, -on_wheel_N) + couple_on_surface_Nm, -on_wheel_N);
  const double curvature_per_m = corner_->context().surface_curvature_per_m;
  if (curvature_per_m > 0.0) {
    body_forces[bodies_.surface][0] -= at.now.parasitic_N / curvature_per_m * at.axis;
  } else if (models::is_indoors(corner_->context().machine)) {
    body_forces[bodies_.surface][1] -= at.now.parasitic_N * at.tangent;
  } else {
    const Vec3 on_hub_Nm = at.now.parasitic_N * at.loaded_radius_m * at.axis;  // the wheel turns about -axis
    body_forces[bodies_.wheel][0] += on_hub_Nm;
    body_forces[bodies_.carrier][0] -= on_hub_Nm;
  }
}

void WheelContact::put_rates(const ContactEvaluation& at, double* z_rates) {
  z_rates[0] = at.slip.deflection_rate_m_s;
  std::copy(at.corner_rates.begin(), at.corner_rates.end(), z_rates + 1);
}

double WheelContact::calc_tire_spring_J(const ContactEvaluation& at) const {
  return models::calc_spring_J(contact_.vertical_N_per_m, std::max(0.0, at.deflection_m));
}

double WheelContact::calc_slip_spring_J(const double* z) const {
  return models::calc_spring_J(contact_.slip_spring_N_per_m, z[0]);
}

double WheelContact::calc_tire_damper_W(const ContactEvaluation& at) const {
  const double spring_N = contact_.vertical_N_per_m * std::max(0.0, at.deflection_m);
  return (at.normal_N - spring_N) * at.deflection_rate_m_s;
}

}  // namespace rollrig::rigs
