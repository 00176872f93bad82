/// One tire that a carriage presses on a drum. The motor's torque is measured.
#include "rigs/machine.h"

namespace rollrig::rigs {

const MachineKind& machine_drum() {
  using namespace columns;
  using namespace models;
  static const MachineKind kind{
      "drum",
      "drum",
      "drum",
      {Surface::kDrum, Specimen::kTire, Restraint::kCarriage, quantities::kDrumTorque},
      {{kSurfaceSpeed, kLoad, kAmbient},
       {{quantities::kSurfaceTemperature, kTemperatureRange, "drum surface"},
        {quantities::kHungTorque, any_number(), "known torque on the sensor, by weights on a lever"}},
       {{quantities::kDrumTorque, any_number(), "motor torque at the drum axle"},
        measure(quantities::kLinerTemperature),
        measure(quantities::kCavityPressure),
        measure(quantities::kGasTemperature)}},
      {},
      "follow_drum",
      nullptr,
      "drum_2m",
      "source"};
  return kind;
}

}  // namespace rollrig::rigs
