/// A vehicle tied down on the rollers of a dynamometer; measured is one wheel on its roller.
#include "rigs/machine.h"

namespace rollrig::rigs {

/// Sensors. Loss force: 2 N offset over a session, 1 N drift in 60 s, 2 N noise of a sample at 1 Hz, Assumed: 0.1 % of
/// a force cell of 5 kN and what compensating inertia leaves. Liner and cavity: as assets/sensors/source.toml.
const MachineKind& machine_dyno() {
  using namespace columns;
  using namespace models;
  static const MachineKind kind{"dyno",
                                "dyno",
                                {Surface::kRoller, Specimen::kWheel, Restraint::kTieDowns, quantities::kLossForce},
                                {{kSurfaceSpeed,
                                  kLoad,
                                  {"longitudinal_force_N", any_number(), "wheel on roller, positive when it drives"},
                                  kAmbient},
                                 {{"surface_temperature_degC", kSetTemperatureRange, "roller surface"}},
                                 {{"loss_force_N", any_number(), "loss between hub and roller over surface speed"},
                                  kLinerTemperature,
                                  kCavityPressure,
                                  kGasTemperature}},
                                {{"loss_force_N", {2.0, 1.0, 60.0, 2.0, 0.0}},
                                 {"liner_temperature_degC", {0.25, 0.05, 60.0, 0.1, 0.1}},
                                 {"gas_temperature_degC", {0.25, 0.05, 60.0, 0.1, 0.1}},
                                 {"cavity_pressure_kPa", {250.0, 100.0, 120.0, 50.0, 100.0}}},
                                "follow_roller"};
  return kind;
}

}  // namespace rollrig::rigs
