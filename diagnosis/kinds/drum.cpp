/// Sets measured on a drum rig.
#include "diagnosis/kinds/tire_rig.h"

namespace rollrig::diagnosis {

const MeasurementKind& drum_kind() {
  static const TireRigKind kind(models::quantities::kDrumTorque, {"torque", "drum torque", "kN m"});
  return kind;
}

}  // namespace rollrig::diagnosis
