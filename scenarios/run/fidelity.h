#pragma once
/// Runs a program on a rig, whichever it is, in one of the two fidelities.

#include "scenarios/run/scenario.h"
#include "sim/ode_system.h"

namespace rollrig::scenarios {

/// A program on a multibody rig, by CVODES, or by a Rosenbrock method where it has many short segments. Where energies
/// do not close to `audit_limit`, as where little moves and much starts and stops, it is run again with a tenth of the
/// tolerances, twice at most. What was counted in the last run goes into `statistics`.
sim::Recording<double> run_multibody(sim::OdeSystem<double>& rig, const sim::Program& program, const RunSpec& spec,
                                     double audit_limit, const sim::Progress& progress, Json& statistics);

/// A program on a quasi-static rig, on a fixed grid. Steps are short near standstill, and grow while no input changes.
/// `speed_input` is the place of the speed among the inputs. A tolerance factor below 1 shortens all steps; one above 1
/// has no effect.
sim::Recording<double> run_quasi_static(sim::OdeSystem<double>& rig, sim::Program program, std::size_t speed_input,
                                        const RunSpec& spec, const sim::Progress& progress);

/// Adds to every channel that has a sensor what that sensor errs, from the run's seed. Nothing without sensors.
void apply_sensors(const RunSpec& spec, sim::Recording<double>& recording);

}  // namespace rollrig::scenarios
