#pragma once
/// Machines and vehicles off every symmetric point: no radius of 1 m, no two axles alike.

#include "rigs/rig_file.h"
#include "rigs/vehicle_file.h"

namespace rollrig::tests {

/// A drum of 1.707 m, with its own inertia and parasitic loss.
rigs::RigFile make_uneven_drum();

/// Rollers of 1.2192 m, likewise.
rigs::RigFile make_uneven_dyno();

/// Load shares 0.57 in front and 0.43 behind, brake shares 0.68 and 0.32; driven at the rear.
rigs::VehicleFile make_uneven_vehicle();

}  // namespace rollrig::tests
