#pragma once
/// Channels over time as panels of one chart: what belongs together is in one panel.

#include <vector>

#include "report/page.h"
#include "sim/recording.h"

namespace rollrig::report {

/// Phases of a recording as the page has them.
Json make_phases(const std::vector<sim::PhaseSpan>& phases);

/// From a minute before the rolling begins to the end: a soak of hours would fill the axis.
PageClock find_view(const sim::Recording<double>& recording);

/// Speed, load, torque and forces, losses, temperatures, pressure, then everything else.
Block make_times(const sim::Recording<double>& recording);

}  // namespace rollrig::report
