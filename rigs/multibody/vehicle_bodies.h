#pragma once
/// Bodies and joints of a multibody vehicle; no forces.

#include <Simbody.h>

#include <vector>

#include "rigs/vehicle_layout.h"

namespace rollrig::rigs {

struct VehicleBodies {
  struct Wheel {
    SimTK::MobilizedBody::Slider upright;
    SimTK::MobilizedBody::Pin wheel;
    SimTK::MobilizedBody::Pin roller;  // empty handle on the road
    double roller_mass_kg = 0.0;       // its inertia over R^2
    double preload_N = 0.0;            // of the suspension when the upright is at its middle
    double loaded_radius_m = 0.0;      // under the static load
    double ballast_N = 0.0;            // weight on the body over this wheel that has no inertia, see add_vehicle_bodies
  };
  SimTK::MobilizedBody::Slider sled;  // empty handle for a quarter on a dynamometer
  SimTK::MobilizedBody::Slider heave;
  SimTK::MobilizedBody body;  // the heave's, or on the road the pitch's
  std::vector<Wheel> wheels;
  bool pitches = false;  // on the road, on more than one axle

  bool has_sled() const { return !sled.isEmptyHandle(); }
};

/// One of each wheel.
using Tires = std::vector<const models::TireParameters<double>*>;

/// Adds them to `matter`. All coordinates are 0 with every wheel under its static load and no restraint.
/// `mass_factor` is on all that the vehicle's longitudinal motion accelerates (effect inertia_error). Where that
/// is less than the bodies on the road have mass, the sprung body is lighter and `ballast_N` makes up its weight.
VehicleBodies add_vehicle_bodies(SimTK::SimbodyMatterSubsystem& matter, const VehicleLayout& layout, const Tires& tires,
                                 double mass_factor);

}  // namespace rollrig::rigs
