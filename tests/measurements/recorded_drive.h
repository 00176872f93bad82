#pragma once
/// A drive of the simulator's vehicle, and what it recorded as a run of a set.

#include "measurements/measurement_set.h"
#include "tests/support/vehicle_fixture.h"

namespace rollrig::tests {

/// The vehicle of the simulator on its rollers or on the road, and what it recorded as a run; of a quarter the load
/// too.
inline measurements::MeasuredRun record(const VehicleFixture& fixture, const sim::Recording<double>& recording) {
  measurements::MeasuredRun run;
  run.initial_tire_temperature_K = fixture.start().tire_temperature_K;
  run.cold_pressure_Pa = fixture.cold_pressure_Pa;
  run.time_s = recording.time_s;
  run.columns["speed_km_h"] = recording.channel("speed_km_h");
  run.columns["ambient_degC"] = recording.channel("ambient_degC");
  if (!fixture.whole) run.columns["load_N"] = recording.channel("load_N");
  run.columns["longitudinal_force_N"].assign(run.time_s.size(), 0.0);
  return run;
}

/// Up and down between two speeds, steady in between.
inline sim::Program driving_program() {
  const double v50 = 50.0 / 3.6;
  const double v110 = 110.0 / 3.6;
  return make_program({driving("up", 40.0, 0.0, v110), driving("fast", 600.0, v110, v110),
                       driving("down", 30.0, v110, v50), driving("slow", 300.0, v50, v50),
                       driving("faster", 30.0, v50, v110), driving("fast again", 300.0, v110, v110)});
}

}  // namespace rollrig::tests
