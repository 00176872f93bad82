#pragma once
/// What the animation of a run needs: sizes of tire and machine, and where each body is over time.

#include "report/page.h"
#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// The drum with its carriage, or the vehicle on rollers or road, from the recorded poses of a multibody run. A
/// quasi-static run has none: angles are then integrals of the recorded speed and heights follow from the load.
Block make_animation(const scenarios::RunSpec& spec, const sim::Recording<double>& recording);

}  // namespace rollrig::report
