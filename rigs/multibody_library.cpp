#include <memory>
#include <vector>

#include "rigs/multibody_drum.h"
#include "rigs/multibody_library.h"
#include "rigs/multibody_vehicle.h"
#include "sim/core/shared_library.h"

namespace rollrig::rigs {
namespace {

const MultibodyLibrary& library() {
  static void* const entry = load_entry(ROLLRIG_MULTIBODY_LIBRARY, kMultibodyEntry, "the library of the multibody rigs",
                                        "the fidelity quasi_static works without it");
  return *reinterpret_cast<MultibodyEntry>(entry)();
}

}  // namespace

std::unique_ptr<MultibodyDrum> make_multibody_drum(models::Corner<double>& corner, const RigFile& rig,
                                                   const RigStart<double>& start, bool surface_recorded) {
  return library().make_drum(corner, rig, start, surface_recorded);
}

std::unique_ptr<MultibodyVehicle> make_multibody_vehicle(std::vector<models::Corner<double>>& corners,
                                                         const VehicleLayout& layout, const RigStart<double>& start,
                                                         bool surface_recorded) {
  return library().make_vehicle(corners, layout, start, surface_recorded);
}

}  // namespace rollrig::rigs
