/// One tire that a carriage presses on a flat belt. The force that drives the belt is measured at its surface.
#include "rigs/machine.h"

namespace rollrig::rigs {

/// Sensors. Belt force: Assumed: as on a drum of 1 m radius, of assets/sensors/source.toml; the tire's: as there.
const MachineKind& machine_flat_belt() {
  using namespace columns;
  using namespace models;
  static const MachineKind kind{"flat_belt",
                                "",
                                {Surface::kBelt, Specimen::kTire, Restraint::kCarriage, quantities::kBeltForce},
                                {{kSurfaceSpeed, kLoad, kAmbient},
                                 {{"surface_temperature_degC", kSetTemperatureRange, "belt surface"}},
                                 {{"belt_force_N", any_number(), "force that drives the belt, at its surface"},
                                  kLinerTemperature,
                                  kCavityPressure,
                                  kGasTemperature}},
                                {{"belt_force_N", {0.45, 0.1, 60.0, 0.25, 0.0}},
                                 {"liner_temperature_degC", {0.25, 0.05, 60.0, 0.1, 0.1}},
                                 {"cavity_pressure_kPa", {250.0, 100.0, 120.0, 50.0, 100.0}}},
                                "follow_drum"};
  return kind;
}

}  // namespace rollrig::rigs
