/// A vehicle on the road. The traction force is known from its motor, and nothing of its tires.
#include "rigs/rig_file.h"
#include "sim/core/assets.h"

namespace rollrig::rigs {

const MachineKind& machine_road();

namespace {

/// Standard air over a level road, which cools tires as that of the assets.
RigFile make_road() {
  static const RigFile of_assets = read_rig(read_config(find_asset("rigs", "road")));
  RigFile road;
  road.name = "road";
  road.kind = &machine_road();
  road.environment.ambient_pressure_Pa = kStandardAtmosphere_Pa;
  road.tire_cooling = of_assets.tire_cooling;
  road.tire_cooling_uncertainties = of_assets.tire_cooling_uncertainties;
  return road;
}

}  // namespace

/// Sensors. Traction force: 10 N offset, 215 N drift in 13 s (wind, surface and slope), 140 N noise, Assumed: as one
/// car's trips leave over a fit of the road load (259 N rms, correlated over 13 s).
const MachineKind& machine_road() {
  using namespace models;
  static const MachineKind kind{"road",
                                "flat",
                                "road",
                                {Surface::kRoad, Specimen::kVehicle, Restraint::kNone, quantities::kTractionForce},
                                {{{quantities::kSpeed, columns::kSurfaceSpeed.range, "vehicle speed"},
                                  {quantities::kElevation, any_number(), "height of the road"},
                                  {quantities::kAmbient, kTemperatureRange, "air"}},
                                 {},
                                 {{quantities::kTractionForce, any_number(), "force at the wheels"}}},
                                {{quantities::kTractionForce, {10.0, 215.0, 13.0, 140.0, 0.0}}},
                                "follow_road",
                                &make_road,
                                "",
                                "road"};
  return kind;
}

}  // namespace rollrig::rigs
