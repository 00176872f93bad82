#include "measurements/replay.h"

#include "measurements/replay_start.h"
#include "rigs/quasi_static_drum.h"
#include "rigs/standstill_grid.h"
#include "sim/fixed_grid_integrator.h"
#include "sim/simulate.h"

namespace rollrig::measurements {

sim::Program make_drum_replay(const MeasuredRun& run) {
  return rigs::refine_near_standstill(make_replay(run), rigs::index_of(rigs::DrumInput::kSpeed));
}

template <class S>
sim::Recording<S> replay_drum_run(const MeasurementSet& set, const MeasuredRun& run, const sim::Program& program,
                                  models::Corner<S>& corner, rigs::Detail detail) {
  rigs::QuasiStaticDrum<S> drum(corner, make_replay_start<S>(run, set.rig->environment.ambient_pressure_Pa),
                                run.has("surface_temperature_degC"), detail);
  sim::FixedGridIntegrator<S> integrator(drum);
  sim::Recording<S> recording = sim::simulate<S>(drum, integrator, program);
  apply_trace_beside_given(run, corner, recording);
  return recording;
}

template sim::Recording<double> replay_drum_run(const MeasurementSet&, const MeasuredRun&, const sim::Program&,
                                                models::Corner<double>&, rigs::Detail);
template sim::Recording<Jet> replay_drum_run(const MeasurementSet&, const MeasuredRun&, const sim::Program&,
                                             models::Corner<Jet>&, rigs::Detail);

}  // namespace rollrig::measurements
