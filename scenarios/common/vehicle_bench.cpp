#include "scenarios/common/vehicle_bench.h"

#include "models/tire_reference.h"
#include "rigs/multibody_vehicle.h"
#include "rigs/quasi_static_vehicle.h"
#include "rigs/trace_effects.h"
#include "scenarios/run/fidelity.h"

namespace rollrig::scenarios {
namespace {

rigs::RigStart<double> make_vehicle_start(const RunSpec& spec, const VehicleConditions& conditions) {
  rigs::RigStart<double> start;
  start.tire_temperature_K = *conditions.initial_tire_K;
  start.cold_pressure_Pa = conditions.pressure_Pa;
  start.ambient_pressure_Pa = spec.rig.environment.ambient_pressure_Pa;
  start.set_history(conditions.tire_state.value == "warm", conditions.rest_before_s);
  return start;
}

}  // namespace

models::Context<double> make_wheel_context(const RunSpec& spec, const rigs::VehicleAxle& axle) {
  const models::TireFile& tire = rigs::tire_of(axle, spec.tire);
  const auto context = rigs::make_vehicle_context(tire, spec.rig, *spec.vehicle, spec.baseline);
  models::require_tire_reference(context, spec.effects, tire.path);
  return context;
}

void simulate_vehicle(const RunSpec& spec, const VehicleConditions& conditions, const VehicleProgram& program,
                      const sim::Progress& progress, Outcome& outcome) {
  const rigs::VehicleLayout layout = conditions.make_layout(spec);
  std::vector<models::Corner<double>> corners;
  for (const rigs::WheelPlace& wheel : layout.wheels) {
    corners.emplace_back(make_wheel_context(spec, spec.vehicle->axles[wheel.axle]), spec.effects);
  }
  const rigs::RigStart<double> start = make_vehicle_start(spec, conditions);
  if (spec.fidelity == Fidelity::kMultibody) {
    const auto vehicle = rigs::make_multibody_vehicle(corners, layout, start, program.surface_recorded());
    outcome.recording =
        run_multibody(*vehicle, program.program(), spec, kDriveAuditLimit, progress, outcome.statistics);
  } else {
    rigs::QuasiStaticVehicle<double> vehicle(corners, layout, start, program.surface_recorded());
    outcome.recording =
        run_quasi_static(vehicle, program.program(), rigs::index_of(rigs::VehicleInput::kSpeed), spec, progress);
  }
  outcome.recording.audit.require_closed(kDriveAuditLimit);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    rigs::apply_trace_effects(corners[i], outcome.recording, [&layout, i](const Quantity& recorded) {
      return rigs::find_at_wheel(recorded, layout, i);
    });
  }
}

}  // namespace rollrig::scenarios
