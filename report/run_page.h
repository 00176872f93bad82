#pragma once
/// The page of `rollrig run`.

#include "report/page.h"
#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Result, energies by section where the scenario has sections, the run over time with its animation, energy balance
/// and all inputs.
Page make_run_page(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome);

}  // namespace rollrig::report
