#pragma once
/// Runs a vehicle's program in the fidelity asked for, with effects and audits.

#include "scenarios/common/vehicle_program.h"
#include "scenarios/run/rig_scenario.h"

namespace rollrig::scenarios {

/// Limit of the audits on a drive, where a hundred times the kinetic energy goes through the hubs.
constexpr double kDriveAuditLimit = 1e-5;

/// What the equations take of the wheels of an axle. Throws InputError.
models::Context<double> make_wheel_context(const RunSpec& spec, const rigs::VehicleAxle& axle);

/// Simulates `program` from soaked tires, checks both audits, applies trace effects, and puts recording and
/// statistics into `outcome`.
void simulate_vehicle(const RunSpec& spec, const VehicleConditions& conditions, const VehicleProgram& program,
                      const sim::Progress& progress, Outcome& outcome);

/// What one phase of a drive came to, for the whole vehicle or for one tire, from its integrals.
class SectionReader {
 public:
  SectionReader(const sim::Recording<double>& recording, const rigs::VehicleLayout& layout, std::size_t phase)
      : integrals_(recording.phase_integrals[phase]), layout_(layout) {}

  /// Of the whole vehicle, also where one wheel with its share was simulated.
  double vehicle(rigs::VehicleIntegral integral) const { return integrals_[rigs::index_of(integral)] / layout_.share; }
  /// Of what does not go with the vehicle's size: distance, time.
  double common(rigs::VehicleIntegral integral) const { return integrals_[rigs::index_of(integral)]; }
  /// Of the whole vehicle by the map of its powertrain, which it must have.
  double battery_J() const { return integrals_[rigs::find_battery_integral(layout_)] / layout_.share; }
  double wheel(rigs::WheelIntegral integral, std::size_t wheel) const {
    return integrals_[rigs::index_of(integral, wheel)];
  }

 private:
  const std::vector<double>& integrals_;
  const rigs::VehicleLayout& layout_;
};

/// A scenario with a vehicle, on rollers or on the road; see rig_scenario.h.
template <class Settings, class Results>
Scenario make_vehicle_scenario(ScenarioText text, std::string default_rig,
                               VehicleProgram (*plan)(const Settings&, const RunSpec&),
                               Results (*evaluate)(const Settings&, const RunSpec&, Outcome&)) {
  Scenario scenario = make_rig_scenario(std::move(text), plan, evaluate, &simulate_vehicle, [](const RunSpec& spec) {
    for (const rigs::VehicleAxle& axle : spec.vehicle->axles) make_wheel_context(spec, axle);
  });
  scenario.runs_on = &models::is_of_vehicle;
  scenario.default_rig = std::move(default_rig);
  scenario.has_vehicle = true;
  return scenario;
}

}  // namespace rollrig::scenarios
