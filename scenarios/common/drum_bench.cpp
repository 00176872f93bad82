#include "scenarios/common/drum_bench.h"

#include "models/tire_reference.h"
#include "rigs/multibody_drum.h"
#include "rigs/quasi_static_drum.h"
#include "rigs/trace_effects.h"
#include "scenarios/common/least_damping.h"
#include "scenarios/run/fidelity.h"

namespace rollrig::scenarios {
namespace {

rigs::RigStart<double> make_drum_start(const RunSpec& spec, const DrumConditions& conditions) {
  rigs::RigStart<double> start;
  start.tire_temperature_K = *conditions.initial_tire_K;
  start.cold_pressure_Pa = *conditions.pressure_Pa;
  start.ambient_pressure_Pa = spec.rig.environment.ambient_pressure_Pa;
  start.set_history(conditions.started_warm, conditions.rest_before_s);
  return start;
}

/// A set run starts where the tire is soaked: its temperature, and the pressure at it, are those of the
/// gas at that time.
void fill_set_starts(const sim::Recording<double>& recording, std::vector<SetRun>& runs) {
  for (SetRun& run : runs) {
    const std::size_t row = recording.row_at(run.start_s);
    run.initial_tire_temperature_K = recording.channel("gas_temperature_degC")[row];
    run.cold_pressure_Pa = recording.channel("cavity_pressure_kPa")[row];
  }
}

/// See require_damping(): the carriage with the wheel, on the vertical spring of the tire.
void check_carriage_damping(const RunSpec& spec) {
  if (spec.fidelity != Fidelity::kMultibody || !spec.tire.has_stiffness) return;
  const models::TireParameters<double>& tire = spec.tire.values;
  const rigs::CarriageParameters& carriage = spec.rig.carriage;
  require_damping({"the carriage", "it would bounce on the tire", spec.rig.path, carriage.damping_N_s_per_m,
                   tire.stiffness.vertical_N_per_m,
                   carriage.mass_kg + tire.geometry.mass_kg + tire.geometry.wheel_mass_kg});
}

}  // namespace

void check_drum(const RunSpec& spec) {
  models::require_tire_reference(rigs::make_context(spec.tire, spec.rig, spec.baseline), spec.effects, spec.tire.path);
  check_carriage_damping(spec);
}

void simulate_on_drum(const RunSpec& spec, const DrumConditions& conditions, const DrumProgram& program,
                      const sim::Progress& progress, Outcome& outcome) {
  models::Corner<double> corner(rigs::make_context(spec.tire, spec.rig, spec.baseline), spec.effects);
  const rigs::RigStart<double> start = make_drum_start(spec, conditions);
  if (spec.fidelity == Fidelity::kMultibody) {
    const auto drum = rigs::make_multibody_drum(corner, spec.rig, start, program.surface_recorded());
    outcome.recording = run_multibody(*drum, program.program(), spec, sim::kAuditLimit, progress, outcome.statistics);
  } else {
    rigs::QuasiStaticDrum<double> drum(corner, start, program.surface_recorded(), rigs::Detail::kFull);
    outcome.recording =
        run_quasi_static(drum, program.program(), rigs::index_of(rigs::DrumInput::kSpeed), spec, progress);
  }
  outcome.recording.audit.require_closed(sim::kAuditLimit);
  outcome.set_runs = program.set_runs();
  fill_set_starts(outcome.recording, outcome.set_runs);
  rigs::apply_trace_effects(corner, outcome.recording);
  apply_sensors(spec, outcome.recording);
}

}  // namespace rollrig::scenarios
