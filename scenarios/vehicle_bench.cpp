#include "scenarios/vehicle_bench.h"

#include <algorithm>

#include "rigs/multibody_vehicle.h"
#include "rigs/quasi_static_drum.h"
#include "rigs/quasi_static_vehicle.h"
#include "rigs/trace_effects.h"
#include "scenarios/integrator_statistics.h"
#include "sim/cvodes_integrator.h"
#include "sim/fixed_grid_integrator.h"

namespace rollrig::scenarios {
namespace {

using Corners = std::vector<models::Corner<double>>;

rigs::VehicleStart<double> make_start(const RunSpec& spec, const VehicleConditions& conditions) {
  rigs::VehicleStart<double> start;
  start.tire_temperature_K = *conditions.initial_tire_K;
  start.cold_pressure_Pa = conditions.pressure_Pa;
  start.ambient_pressure_Pa = spec.rig.environment.ambient_pressure_Pa;
  start.history.started_warm = conditions.tire_state.value == "warm";
  start.history.soaked = !start.history.started_warm && !conditions.rest_before_s.has_value();
  start.history.rest_before_s = conditions.rest_before_s.value_or(0.0);
  return start;
}

sim::Recording<double> run_multibody(const RunSpec& spec, Corners& corners, const rigs::VehicleLayout& layout,
                                     const rigs::VehicleStart<double>& start, const VehicleProgram& program,
                                     const sim::Progress& progress, Json& statistics) {
  rigs::MultibodyVehicle vehicle(corners, layout, *spec.vehicle, spec.rig, start, program.surface_recorded());
  sim::CvodesOptions options;
  options.tolerance_factor = spec.tolerance_factor;
  sim::CvodesIntegrator integrator(vehicle, options);
  sim::Recording<double> recording = sim::simulate<double>(vehicle, integrator, program.program(), progress);
  statistics = to_json(integrator.statistics());
  return recording;
}

sim::Recording<double> run_quasi_static(const RunSpec& spec, Corners& corners, const rigs::VehicleLayout& layout,
                                        const rigs::VehicleStart<double>& start, const VehicleProgram& program,
                                        const sim::Progress& progress) {
  rigs::QuasiStaticVehicle<double> vehicle(corners, layout, start, program.surface_recorded());
  sim::FixedGridIntegrator<double> integrator(vehicle);
  static_assert(rigs::index_of(rigs::VehicleInput::kSpeed) == rigs::index_of(rigs::DrumInput::kSpeed));
  sim::Program on_grid = rigs::refine_near_standstill(program.program());
  // A coarser grid than the phase's own is not stable.
  for (sim::Phase& phase : on_grid.phases) phase.max_step_s *= std::min(1.0, spec.tolerance_factor);
  return sim::simulate<double>(vehicle, integrator, on_grid, progress);
}

}  // namespace

void simulate_vehicle(const RunSpec& spec, const VehicleConditions& conditions, const VehicleProgram& program,
                      const sim::Progress& progress, Outcome& outcome) {
  const rigs::VehicleLayout layout = conditions.make_layout(spec);
  const models::Context<double> context = rigs::make_vehicle_context(spec.tire, spec.rig, *spec.vehicle, spec.baseline);
  Corners corners(layout.wheels.size(), models::Corner<double>(context, spec.effects));
  const rigs::VehicleStart<double> start = make_start(spec, conditions);
  outcome.recording = spec.fidelity == Fidelity::kMultibody
                          ? run_multibody(spec, corners, layout, start, program, progress, outcome.statistics)
                          : run_quasi_static(spec, corners, layout, start, program, progress);
  outcome.recording.audit.require_closed(kDriveAuditLimit);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    rigs::apply_trace_effects(corners[i], outcome.recording, [&layout, i](const std::string& recorded) {
      return rigs::name_at_wheel(recorded, layout, i);
    });
  }
}

}  // namespace rollrig::scenarios
