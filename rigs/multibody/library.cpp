#include "rigs/multibody_library.h"

#include "rigs/multibody/drum_system.h"
#include "rigs/multibody/vehicle_system.h"

namespace rollrig::rigs {
namespace {

class Library : public MultibodyLibrary {
 public:
  std::unique_ptr<MultibodyDrum> make_drum(models::Corner<double>& corner, const RigFile& rig,
                                           const RigStart<double>& start, bool surface_recorded) const override {
    return make_drum_system(corner, rig, start, surface_recorded);
  }
  std::unique_ptr<MultibodyVehicle> make_vehicle(std::vector<models::Corner<double>>& corners,
                                                 const VehicleLayout& layout, const RigStart<double>& start,
                                                 bool surface_recorded) const override {
    return make_vehicle_system(corners, layout, start, surface_recorded);
  }
};

}  // namespace
}  // namespace rollrig::rigs

extern "C" __attribute__((visibility("default"))) const rollrig::rigs::MultibodyLibrary* rollrig_multibody_library() {
  static const rollrig::rigs::Library library;
  return &library;
}
