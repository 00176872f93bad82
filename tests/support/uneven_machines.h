#pragma once
/// Machines and vehicles off every symmetric point: no radius of 1 m, no two axles alike.

#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"

namespace rollrig::tests {

/// A drum of 1.707 m, with its own inertia and parasitic loss.
rigs::RigFile make_uneven_drum();

/// Rollers of 1.2192 m, likewise.
rigs::RigFile make_uneven_dyno();

/// The source's car with load shares 0.56 in front and 0.44 behind, brake shares 0.68 and 0.32; driven at the rear.
rigs::VehicleFile make_uneven_vehicle();

/// Axles of a vehicle that has two.
constexpr std::size_t kFront = 0;
constexpr std::size_t kRear = 1;

/// Shares of the front axle; the rear has the rest.
void set_front_load(rigs::VehicleFile& vehicle, double share);
void set_front_drive(rigs::VehicleFile& vehicle, double share);
void set_front_brakes(rigs::VehicleFile& vehicle, double share);

}  // namespace rollrig::tests
