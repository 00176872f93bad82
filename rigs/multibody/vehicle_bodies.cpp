#include "rigs/multibody/vehicle_bodies.h"

#include <algorithm>

#include "models/wheel/rolling_wheel.h"
#include "rigs/multibody/simbody_system.h"

namespace rollrig::rigs {

using SimTK::MobilizedBody;
using SimTK::Transform;
using SimTK::Vec3;

namespace {

Transform upwards(const Vec3& at_m) { return {kUpwards.R(), at_m}; }

/// The sprung mass: its center where the suspensions' preloads balance. Assumed: its pitch inertia is its mass times
/// the square of the distance from the vehicle's center to its farthest axle (m a b where two axles are equally far).
SimTK::Body::Rigid make_sprung_body(const VehicleLayout& layout, VehicleBodies& bodies, double missing_kg) {
  double weight_N = 0.0;
  double moment_Nm = 0.0;
  double spread_m2 = 1.0;
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    weight_N += bodies.wheels[i].preload_N;
    moment_Nm += bodies.wheels[i].preload_N * layout.wheels[i].axle_x_m;
    spread_m2 = std::max(spread_m2, layout.wheels[i].axle_x_m * layout.wheels[i].axle_x_m);
  }
  for (VehicleBodies::Wheel& wheel : bodies.wheels) {
    wheel.ballast_N = missing_kg * kStandardGravity_m_s2 * wheel.preload_N / weight_N;
  }
  const double mass_kg = weight_N / kStandardGravity_m_s2 - missing_kg;
  const Vec3 center_m(moment_Nm / weight_N, 0, 0);
  const SimTK::Inertia central(mass_kg * spread_m2);
  return SimTK::Body::Rigid(SimTK::MassProperties(mass_kg, center_m, central.shiftFromMassCenter(center_m, mass_kg)));
}

/// What moves along the road with the vehicle and is in no other body; negative where those have more.
double calc_other_mass_kg(const VehicleLayout& layout, const VehicleBodies& bodies, const Tires& tires,
                          double mass_factor) {
  double spin_kg = 0.0;
  for (std::size_t i = 0; i < tires.size(); ++i) {
    spin_kg += models::calc_spin_mass_kg(*tires[i], bodies.wheels[i].loaded_radius_m);
  }
  const double total_kg = mass_factor * (layout.mass_kg + layout.rotating_mass_kg) - spin_kg;
  return is_on_road(layout.machine) ? total_kg - layout.mass_kg : total_kg;
}

void add_wheel(SimTK::SimbodyMatterSubsystem& matter, const VehicleLayout& layout,
               const models::TireParameters<double>& tire, std::size_t i, VehicleBodies& bodies) {
  VehicleBodies::Wheel& wheel = bodies.wheels[i];
  const double axle_x_m = layout.wheels[i].axle_x_m;
  const Vec3 hub_m(axle_x_m, wheel.loaded_radius_m - layout.body_height_m, 0);
  wheel.upright = MobilizedBody::Slider(bodies.body, upwards(hub_m),
                                        make_block(layout.wheels[i].suspension.unsprung_mass_kg), kUpwards);
  wheel.wheel = MobilizedBody::Pin(wheel.upright, kReversed, make_wheel(tire), kReversed);
  if (is_on_road(layout.machine)) return;
  const double radius_m = layout.roller_radius_m;
  wheel.roller =
      MobilizedBody::Pin(matter.Ground(), Transform(Vec3(axle_x_m, -radius_m, 0)),
                         make_rotor(wheel.roller_mass_kg, wheel.roller_mass_kg * radius_m * radius_m), Transform());
}

}  // namespace

VehicleBodies add_vehicle_bodies(SimTK::SimbodyMatterSubsystem& matter, const VehicleLayout& layout, const Tires& tires,
                                 double mass_factor) {
  const bool flat = is_on_road(layout.machine);
  VehicleBodies bodies;
  bodies.wheels.resize(layout.wheels.size());
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    const double unsprung_N = calc_unsprung_N(layout.wheels[i].suspension, *tires[i]);
    bodies.wheels[i].preload_N = layout.wheels[i].static_load_N - unsprung_N;
    bodies.wheels[i].loaded_radius_m = calc_loaded_radius_m(*tires[i], layout.wheels[i].static_load_N);
  }
  const double other_kg = calc_other_mass_kg(layout, bodies, tires, mass_factor);
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) {
    bodies.wheels[i].roller_mass_kg = other_kg * layout.wheels[i].static_load_N / layout.rolling_load_N;
  }
  const Vec3 height_m(0, layout.body_height_m, 0);
  const SimTK::Body::Rigid sprung = make_sprung_body(layout, bodies, flat ? std::max(0.0, -other_kg) : 0.0);
  MobilizedBody* base = &matter.Ground();
  if (flat || layout.wheels.size() > 1) {
    bodies.sled = MobilizedBody::Slider(matter.Ground(), Transform(height_m),
                                        make_block(flat ? std::max(0.0, other_kg) : 0.0), Transform());
    base = &bodies.sled;
  }
  const Vec3 start_m = bodies.has_sled() ? Vec3(0) : height_m;
  bodies.pitches = flat && layout.wheels.front().axle != layout.wheels.back().axle;
  const SimTK::Body massless = SimTK::Body::Massless();
  bodies.heave =
      MobilizedBody::Slider(*base, upwards(start_m), bodies.pitches ? massless : SimTK::Body(sprung), kUpwards);
  bodies.body = bodies.heave;
  if (bodies.pitches) bodies.body = MobilizedBody::Pin(bodies.heave, Transform(), sprung, Transform());
  for (std::size_t i = 0; i < layout.wheels.size(); ++i) add_wheel(matter, layout, *tires[i], i, bodies);
  return bodies;
}

}  // namespace rollrig::rigs
