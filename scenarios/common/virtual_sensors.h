#pragma once
/// Errors of the sensors that a run asks for.

#include "scenarios/run/scenario.h"

namespace rollrig::scenarios {

/// Adds to every channel that has a sensor what that sensor errs, from the run's seed. Nothing without sensors.
void apply_sensors(const RunSpec& spec, sim::Recording<double>& recording);

}  // namespace rollrig::scenarios
