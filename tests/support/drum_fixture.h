#pragma once
/// A tire, a rig and short programs for tests, and both fidelities over them.

#include <string>
#include <vector>

#include "models/corner.h"
#include "rigs/multibody_drum.h"
#include "rigs/quasi_static_drum.h"
#include "scenarios/run/run_spec.h"
#include "sim/cvodes_integrator.h"
#include "sim/fixed_grid_integrator.h"
#include "sim/simulate.h"
#include "tests/support/uneven_machines.h"

namespace rollrig::tests {

/// A tire of the assets.
models::TireFile read_asset_tire(const std::string& name);
/// A tire of tests/published/combined_law: the source's own law, with conductances for drum_2m and dyno_1m2.
std::string combined_tire_path(const std::string& name = "a50");
models::TireFile read_combined_tire(const std::string& name = "a50");
/// Rig drum_2m of the assets.
rigs::RigFile read_asset_rig();

/// A tire model with usual numbers of its own.
models::OwnParameters<double> make_own(const std::string& model);

/// A drum test that a test may change before it runs.
struct DrumFixture {
  models::TireFile tire = read_combined_tire();
  rigs::RigFile rig = make_uneven_drum();
  models::Baseline baseline = models::Baseline::kCombined;
  std::vector<models::ActiveEffect> effects;
  double initial_K = 298.15;
  double cold_pressure_Pa = 280e3;
  sim::CvodesOptions cvodes;

  models::Context<double> context() const { return rigs::make_context(tire, rig, baseline); }
  models::Corner<double> corner() const { return {context(), effects}; }
  rigs::RigStart<double> start() const;
  sim::Recording<double> run_multibody(const sim::Program& program) const;
  sim::Recording<double> run_quasi_static(const sim::Program& program) const;
};

/// A segment of a drum program at 25 degC.
sim::Segment drum_segment(double duration_s, double speed_start_m_s, double speed_end_m_s, double load_N,
                          double ambient_K = 298.15);
/// One phase of one segment at constant speed and load.
sim::Phase rolling(const std::string& name, double duration_s, double speed_m_s, double load_N);

/// An effect switched on, its parameters as usual but for the first ones, in the units of its keys.
models::ActiveEffect make_active(const models::Effect& effect, const std::vector<double>& first_values);

/// A run spec of a scenario on the assets, with settings as of --set.
scenarios::RunSpec make_spec(const std::string& scenario, const std::string& tire,
                             const std::vector<std::string>& settings = {}, const std::string& fidelity = "multibody");

/// Runs it, in the fast fidelity unless said.
scenarios::Outcome run(const std::string& scenario, const std::string& tire,
                       const std::vector<std::string>& settings = {}, const std::string& fidelity = "quasi_static");
/// A number of its result.
double number(const scenarios::Outcome& outcome, const char* key);

}  // namespace rollrig::tests
