#include "scenarios/drum_bench.h"

#include <algorithm>

#include "rigs/multibody_drum.h"
#include "rigs/quasi_static_drum.h"
#include "rigs/trace_effects.h"
#include "scenarios/integrator_statistics.h"
#include "sim/cvodes_integrator.h"
#include "sim/fixed_grid_integrator.h"

namespace rollrig::scenarios {
namespace {

sim::Recording<double> run_multibody(const RunSpec& spec, models::Corner<double>& corner,
                                     const rigs::DrumStart<double>& start, const DrumProgram& program,
                                     const sim::Progress& progress, Json& statistics) {
  rigs::MultibodyDrum drum(corner, spec.rig, start, program.surface_recorded());
  sim::CvodesOptions options;
  options.tolerance_factor = spec.tolerance_factor;
  sim::CvodesIntegrator integrator(drum, options);
  sim::Recording<double> recording = sim::simulate<double>(drum, integrator, program.program(), progress);
  statistics = to_json(integrator.statistics());
  return recording;
}

sim::Recording<double> run_quasi_static(const RunSpec& spec, models::Corner<double>& corner,
                                        const rigs::DrumStart<double>& start, const DrumProgram& program,
                                        const sim::Progress& progress) {
  rigs::QuasiStaticDrum<double> drum(corner, start, program.surface_recorded(), rigs::Detail::kFull);
  sim::FixedGridIntegrator<double> integrator(drum);
  sim::Program on_grid = rigs::refine_near_standstill(program.program());
  for (sim::Phase& phase : on_grid.phases) phase.max_step_s *= spec.tolerance_factor;
  return sim::simulate<double>(drum, integrator, on_grid, progress);
}

rigs::DrumStart<double> make_start(const RunSpec& spec, const DrumConditions& conditions) {
  rigs::DrumStart<double> start;
  start.tire_temperature_K = *conditions.initial_tire_K;
  start.cold_pressure_Pa = *conditions.pressure_Pa;
  start.ambient_pressure_Pa = spec.rig.environment.ambient_pressure_Pa;
  return start;
}

/// A set run starts where the tire is soaked: its temperature, and the pressure at it, are those of the
/// gas at that time.
void fill_set_starts(const sim::Recording<double>& recording, std::vector<SetRun>& runs) {
  for (SetRun& run : runs) {
    const auto row = std::lower_bound(recording.time_s.begin(), recording.time_s.end(), run.start_s - 1e-9);
    const auto index = static_cast<std::size_t>(row - recording.time_s.begin());
    run.initial_tire_temperature_K = recording.channel("gas_temperature_degC")[index];
    run.cold_pressure_Pa = recording.channel("cavity_pressure_kPa")[index];
  }
}

void apply_sensors(const RunSpec& spec, sim::Recording<double>& recording) {
  for (const auto& [channel, sensor] : *spec.sensors) {
    models::apply_sensor(sensor, channel, {spec.seed, "session", "run"}, recording.time_s, recording.channel(channel));
  }
}

}  // namespace

const std::vector<std::string>& measured_drum_channels() {
  static const std::vector<std::string> channels{"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa",
                                                 "gas_temperature_degC"};
  return channels;
}

void simulate_on_drum(const RunSpec& spec, const DrumConditions& conditions, const DrumProgram& program,
                      const sim::Progress& progress, Outcome& outcome) {
  models::Corner<double> corner(rigs::make_context(spec.tire, spec.rig, spec.baseline), spec.effects);
  const rigs::DrumStart<double> start = make_start(spec, conditions);
  outcome.recording = spec.fidelity == Fidelity::kMultibody
                          ? run_multibody(spec, corner, start, program, progress, outcome.statistics)
                          : run_quasi_static(spec, corner, start, program, progress);
  outcome.recording.audit.require_closed(sim::kAuditLimit);
  outcome.set_runs = program.set_runs();
  fill_set_starts(outcome.recording, outcome.set_runs);
  rigs::apply_trace_effects(corner, outcome.recording);
  if (spec.sensors.has_value()) apply_sensors(spec, outcome.recording);
}

}  // namespace rollrig::scenarios
