#include "identification/replay.h"

#include "rigs/quasi_static_drum.h"
#include "rigs/standstill_grid.h"
#include "rigs/trace_effects.h"
#include "sim/fixed_grid_integrator.h"
#include "sim/simulate.h"

namespace rollrig::identification {
namespace {

template <class S>
rigs::DrumStart<S> make_start(const scenarios::MeasurementSet& set, const scenarios::MeasuredRun& run) {
  rigs::DrumStart<S> start;
  start.tire_temperature_K = S(run.initial_tire_temperature_K);
  start.cold_pressure_Pa = S(run.cold_pressure_Pa);
  start.ambient_pressure_Pa = S(set.rig->environment.ambient_pressure_Pa);
  start.history.soaked = !run.rest_before_s.has_value() && !run.started_warm;
  start.history.rest_before_s = S(run.rest_before_s.value_or(0.0));
  start.history.started_warm = run.started_warm;
  return start;
}

}  // namespace

sim::Program make_drum_replay(const scenarios::MeasuredRun& run) {
  return rigs::refine_near_standstill(scenarios::make_replay(run), rigs::index_of(rigs::DrumInput::kSpeed));
}

namespace {

/// Gives effects of the port "trace" the recorded inputs that they may read.
template <class S>
void add_given_channels(const scenarios::MeasuredRun& run, sim::Recording<S>& recording) {
  for (const char* name : {"load_N", "ambient_degC"}) {
    const std::vector<double>& given = run.columns.at(name);
    recording.channels.push_back({name});
    recording.values.emplace_back(given.begin(), given.end());
  }
}

}  // namespace

template <class S>
sim::Recording<S> replay_drum_run(const scenarios::MeasurementSet& set, const scenarios::MeasuredRun& run,
                                  const sim::Program& program, models::Corner<S>& corner, rigs::Detail detail) {
  rigs::QuasiStaticDrum<S> drum(corner, make_start<S>(set, run), run.has("surface_temperature_degC"), detail);
  sim::FixedGridIntegrator<S> integrator(drum);
  sim::Recording<S> recording = sim::simulate<S>(drum, integrator, program);
  if (rigs::has_trace_effects(corner)) {
    add_given_channels(run, recording);
    rigs::apply_trace_effects(corner, recording);
  }
  return recording;
}

template sim::Recording<double> replay_drum_run(const scenarios::MeasurementSet&, const scenarios::MeasuredRun&,
                                                const sim::Program&, models::Corner<double>&, rigs::Detail);
template sim::Recording<Jet> replay_drum_run(const scenarios::MeasurementSet&, const scenarios::MeasuredRun&,
                                             const sim::Program&, models::Corner<Jet>&, rigs::Detail);

}  // namespace rollrig::identification
