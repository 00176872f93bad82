#include <dlfcn.h>
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "rigs/multibody_drum.h"
#include "rigs/multibody_library.h"
#include "rigs/multibody_vehicle.h"
#include "sim/core/error.h"

namespace rollrig::rigs {
namespace {

/// Looked for where the other shared libraries of this program are. It stays loaded: its rigs may outlive all else.
const MultibodyLibrary& load_library() {
  void* handle = ::dlopen(ROLLRIG_MULTIBODY_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  void* entry = handle == nullptr ? nullptr : ::dlsym(handle, kMultibodyEntry);
  if (entry == nullptr) {
    throw RunFailure(
        fmt::format("the library of the multibody rigs cannot be loaded: {}; it is installed with rollrig, beside its "
                    "other libraries; the fidelity quasi_static works without it",
                    ::dlerror()));
  }
  return *reinterpret_cast<MultibodyEntry>(entry)();
}

const MultibodyLibrary& library() {
  static const MultibodyLibrary& loaded = load_library();
  return loaded;
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
