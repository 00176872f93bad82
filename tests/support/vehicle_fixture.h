#pragma once
/// A vehicle, a rig and short programs for tests, and both fidelities over them.

#include <string>
#include <vector>

#include "rigs/multibody_vehicle.h"
#include "rigs/quasi_static_vehicle.h"
#include "sim/cvodes_integrator.h"
#include "sim/program.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/uneven_machines.h"

namespace rollrig::tests {

/// A run of a vehicle that a test may change before it runs: source_car with uneven axles (0.56 and 0.44 of the load,
/// 0.68 and 0.32 of the brakes) on tires a50, soaked at the rig's ambient.
struct VehicleFixture {
  /// `rig_name` is dyno_1m2 or flat; a quarter stands on the axle named.
  explicit VehicleFixture(const std::string& rig_name, bool is_whole = false, std::size_t quarter_wheel = kRear);

  models::TireFile tire = read_combined_tire();
  rigs::RigFile rig;
  rigs::VehicleFile vehicle = make_uneven_vehicle();
  models::RoadLoad<double> set_load;  // of the rollers
  bool whole;
  std::size_t quarter;
  models::Baseline baseline = models::Baseline::kCombined;
  std::vector<models::ActiveEffect> effects;
  double cold_pressure_Pa = 280e3;
  sim::CvodesOptions cvodes;

  /// Tires without loss, bearings of the rig without friction.
  void take_losses_away();
  double total_mass_kg() const { return vehicle.body.mass_kg + vehicle.body.rotating_mass_kg; }

  rigs::VehicleLayout layout() const;
  models::Context<double> context() const { return context_of(vehicle.axles.front()); }
  models::Context<double> context_of(const rigs::VehicleAxle& axle) const {
    return rigs::make_vehicle_context(rigs::tire_of(axle, tire), rig, vehicle, baseline);
  }
  std::vector<models::Corner<double>> corners() const;
  rigs::RigStart<double> start() const;
  sim::Recording<double> run_multibody(const sim::Program& program) const;
  /// By the method that follows drive cycles (sim/rosenbrock_integrator.h).
  sim::Recording<double> run_multibody_rosenbrock(const sim::Program& program) const;
  sim::Recording<double> run_quasi_static(const sim::Program& program) const;
  sim::Recording<double> run(bool multibody, const sim::Program& program) const {
    return multibody ? run_multibody(program) : run_quasi_static(program);
  }
};

/// A segment of a vehicle's program at 20 degC.
sim::Segment vehicle_segment(double duration_s, double speed_start_m_s, double speed_end_m_s, double slope = 0.0,
                             double wind_m_s = 0.0);
/// One phase of one segment with the driver on.
sim::Phase driving(const std::string& name, double duration_s, double speed_start_m_s, double speed_end_m_s,
                   double slope = 0.0);
/// Neutral until the speed falls to `end_m_s`.
sim::Phase coasting(double start_m_s, double end_m_s, double longest_s = 4000.0, double slope = 0.0,
                    double wind_m_s = 0.0);
sim::Program make_program(std::vector<sim::Phase> phases);

/// Change of an integral of the whole run.
double find_total(const sim::Recording<double>& recording, rigs::VehicleIntegral integral);

}  // namespace rollrig::tests
