/// One tire that a carriage presses on a drum. The motor's torque is measured.
#include "rigs/machine.h"

namespace rollrig::rigs {

const MachineKind& machine_drum() {
  using namespace columns;
  using namespace models;
  static const MachineKind kind{
      "drum",
      "drum",
      {Surface::kDrum, Specimen::kTire, Restraint::kCarriage, quantities::kDrumTorque},
      {{kSurfaceSpeed, kLoad, kAmbient},
       {{"surface_temperature_degC", kSetTemperatureRange, "drum surface"},
        {"hung_torque_Nm", any_number(), "known torque on the sensor, by weights on a lever"}},
       {{"drum_torque_Nm", any_number(), "motor torque at the drum axle"},
        kLinerTemperature,
        kCavityPressure,
        kGasTemperature}},
      {},
      "follow_drum"};
  return kind;
}

}  // namespace rollrig::rigs
