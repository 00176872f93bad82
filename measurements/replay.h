#pragma once
/// A measured drum run simulated again from its recorded inputs.

#include "measurements/measurement_set.h"
#include "models/corner.h"
#include "rigs/drum_channels.h"
#include "sim/recording.h"

namespace rollrig::measurements {

/// The program of a drum run's recorded inputs, on a grid fit for the quasi-static rig.
sim::Program make_drum_replay(const MeasuredRun& run);

/// What the sensors of a drum rig would have shown: the corner with its effects, quasi-static, rows at the run's own
/// times, trace effects applied. With full detail, also what only a simulation knows.
template <class S>
sim::Recording<S> replay_drum_run(const MeasurementSet& set, const MeasuredRun& run, const sim::Program& program,
                                  models::Corner<S>& corner, rigs::Detail detail = rigs::Detail::kMeasured);

}  // namespace rollrig::measurements
