#pragma once
/// Bodies, joints and forces of a vehicle in Simbody; see rigs/multibody_vehicle.h.

#include <memory>
#include <vector>

#include "rigs/multibody_vehicle.h"

namespace rollrig::rigs {

std::unique_ptr<MultibodyVehicle> make_vehicle_system(std::vector<models::Corner<double>>& corners,
                                                      const VehicleLayout& layout, const RigStart<double>& start,
                                                      bool surface_recorded);

}  // namespace rollrig::rigs
