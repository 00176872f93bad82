#pragma once
/// What `rollrig run` shows: the page with its parts, the text of the terminal.

#include <optional>

#include "report/page.h"
#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Result, energies by section where the scenario has sections, the run over time with its animation, energy balance
/// and all inputs.
Page make_run_page(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome);

/// Header, lines, tables and warnings of a run for the terminal.
std::string format_outcome(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome);

/// The drum with its carriage, or the vehicle on rollers or road, from the recorded poses of a multibody run. A
/// quasi-static run has none: angles are then integrals of the recorded speed and heights follow from the load.
Block make_animation(const scenarios::RunSpec& spec, const sim::Recording<double>& recording);

/// A section through the tire with its temperatures and heat flows over time; none where the recording does not have
/// what they follow from. On a vehicle of the first wheel that rolls.
std::optional<Block> make_cross_section(const scenarios::RunSpec& spec, const sim::Recording<double>& recording);

/// The chart that shows the result of a run at a glance: road load over speed, energy by section, resistance from cycle
/// to cycle, the parts of a loss; else rolling resistance over the time under load. None where there is nothing of
/// these.
std::optional<Block> make_first_figure(const Json& result, const sim::Recording<double>& recording);

/// The other figures of `result`: temperatures by section, forces and coefficients by cycle. No blocks where it has
/// nothing of these.
Section make_run_figures(const Json& result);

/// The coastdowns of `result` one over the other, and their times through bins of speed; no blocks where it has none.
Section make_coast_figures(const Json& result, const sim::Recording<double>& recording);

/// Phases of a recording as the page has them.
Json make_phases(const std::vector<sim::PhaseSpan>& phases);

/// From a minute before the rolling begins to the end: a soak of hours would fill the axis.
PageClock find_view(const sim::Recording<double>& recording);

/// Channels over time as panels of one chart: speed, load, torque and forces, losses, temperatures, pressure, then
/// everything else.
Block make_times(const sim::Recording<double>& recording);

}  // namespace rollrig::report
