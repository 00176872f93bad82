/// One tire that a carriage presses on a flat belt. The force that drives the belt is measured at its surface.
#include "rigs/machine.h"

namespace rollrig::rigs {
namespace {

constexpr Quantity kBeltForce{"belt_force", "N"};

}  // namespace

/// Sensors. Belt force: Assumed: as on a drum of 1 m radius, of assets/sensors/source.toml; the tire's: as there.
const MachineKind& machine_flat_belt() {
  using namespace columns;
  using namespace models;
  static const MachineKind kind{"flat_belt",
                                "",
                                "flat_belt",
                                {Surface::kBelt, Specimen::kTire, Restraint::kCarriage, kBeltForce},
                                {{kSurfaceSpeed, kLoad, kAmbient},
                                 {{quantities::kSurfaceTemperature, kTemperatureRange, "belt surface"},
                                  {quantities::kHungForce, any_number(), "known force on the sensor, by weights"}},
                                 {{kBeltForce, any_number(), "force that drives the belt, at its surface"},
                                  measure(quantities::kLinerTemperature),
                                  measure(quantities::kCavityPressure),
                                  measure(quantities::kGasTemperature)}},
                                {{kBeltForce, {0.45, 0.1, 60.0, 0.25, 0.0}},
                                 make_usual_sensor(quantities::kLinerTemperature),
                                 make_usual_sensor(quantities::kCavityPressure)},
                                "follow_drum",
                                nullptr,
                                "flat_belt",
                                "flat_belt"};
  return kind;
}

}  // namespace rollrig::rigs
