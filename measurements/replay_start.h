#pragma once
/// What replays of all kinds of runs share: where a run starts, and what its recording goes through at the end.

#include "measurements/measurement_set.h"
#include "rigs/drum_channels.h"
#include "rigs/trace_effects.h"

namespace rollrig::measurements {

/// Temperature, pressure and history that a run states of its beginning.
template <class S>
rigs::RigStart<S> make_replay_start(const MeasuredRun& run, double ambient_pressure_Pa) {
  rigs::RigStart<S> start;
  start.tire_temperature_K = S(run.initial_tire_temperature_K);
  start.cold_pressure_Pa = S(run.cold_pressure_Pa);
  start.ambient_pressure_Pa = S(ambient_pressure_Pa);
  start.history.soaked = !run.rest_before_s.has_value() && !run.started_warm;
  start.history.rest_before_s = S(run.rest_before_s.value_or(0.0));
  start.history.started_warm = run.started_warm;
  return start;
}

/// Effects of the port "trace", beside the recorded inputs that they may read.
template <class S>
void apply_trace_beside_given(const MeasuredRun& run, const models::Corner<S>& corner, sim::Recording<S>& recording) {
  if (!rigs::has_trace_effects(corner)) return;
  for (const char* name : {"load_N", "ambient_degC"}) {
    if (!run.has(name)) continue;
    const std::vector<double>& given = run.columns.at(name);
    recording.channels.push_back({name});
    recording.values.emplace_back(given.begin(), given.end());
  }
  rigs::apply_trace_effects(corner, recording);
}

}  // namespace rollrig::measurements
