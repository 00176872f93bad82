/// A vehicle tied down on the rollers of a dynamometer; measured is one wheel on its roller.
#include "rigs/machine.h"

namespace rollrig::rigs {

/// Sensors. Loss force: 2 N offset over a session, 1 N drift in 60 s, 2 N noise of a sample at 1 Hz, Assumed: 0.1 % of
/// a force cell of 5 kN and what compensating inertia leaves. Liner and cavity: as assets/sensors/source.toml.
const MachineKind& machine_dyno() {
  using namespace columns;
  using namespace models;
  static const MachineKind kind{
      "dyno",
      "dyno",
      "roller",
      {Surface::kRoller, Specimen::kWheel, Restraint::kTieDowns, quantities::kLossForce},
      {{kSurfaceSpeed,
        kLoad,
        {quantities::kLongitudinalForce, any_number(), "wheel on roller, positive when it drives"},
        kAmbient},
       {{quantities::kSurfaceTemperature, kTemperatureRange, "roller surface"},
        {quantities::kHungForce, any_number(), "known force on the sensor at the surface, by weights on a lever"}},
       {{quantities::kLossForce, any_number(), "loss between hub and roller over surface speed"},
        measure(quantities::kLinerTemperature),
        measure(quantities::kCavityPressure),
        measure(quantities::kGasTemperature),
        {quantities::kContactLoad, any_number(), "load under the wheel, by a scale or a cell under the roller"},
        {quantities::kSpeedReading, any_number(), "surface speed by a counter of its own"}}},
      {{quantities::kLossForce, {2.0, 1.0, 60.0, 2.0, 0.0}},
       make_usual_sensor(quantities::kLinerTemperature),
       make_usual_sensor(quantities::kGasTemperature),
       make_usual_sensor(quantities::kCavityPressure),
       {quantities::kContactLoad, kUsualScale},
       {quantities::kSpeedReading, kUsualCounter}},
      "follow_roller",
      nullptr,
      "dyno_1m2",
      "dyno"};
  return kind;
}

}  // namespace rollrig::rigs
