#pragma once
/// The interface of the shared library of all that needs Simbody. It is loaded when the first multibody rig is made,
/// and not before, since to load Simbody takes time (docs/architecture.md).

#include <memory>
#include <vector>

#include "rigs/multibody_drum.h"
#include "rigs/multibody_vehicle.h"

namespace rollrig::rigs {

/// What the library makes. All is virtual, so that a program needs no symbol of the library to call it.
class MultibodyLibrary {
 public:
  virtual ~MultibodyLibrary() = default;
  virtual std::unique_ptr<MultibodyDrum> make_drum(models::Corner<double>& corner, const RigFile& rig,
                                                   const RigStart<double>& start, bool surface_recorded) const = 0;
  virtual std::unique_ptr<MultibodyVehicle> make_vehicle(std::vector<models::Corner<double>>& corners,
                                                         const VehicleLayout& layout, const RigStart<double>& start,
                                                         bool surface_recorded) const = 0;
};

/// The only function that the library shows, by this name.
using MultibodyEntry = const MultibodyLibrary* (*)();
constexpr const char* kMultibodyEntry = "rollrig_multibody_library";

}  // namespace rollrig::rigs
