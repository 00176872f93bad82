#pragma once
/// Bodies, joints and forces of the drum rig in Simbody; see rigs/multibody_drum.h.

#include <memory>

#include "rigs/multibody_drum.h"

namespace rollrig::rigs {

std::unique_ptr<MultibodyDrum> make_drum_system(models::Corner<double>& corner, const RigFile& rig,
                                                const RigStart<double>& start, bool surface_recorded);

}  // namespace rollrig::rigs
