#pragma once
/// Figures of what a scenario's result holds beside single numbers.

#include "report/page.h"

namespace rollrig::report {

/// Of `result`: rolling energy by section with that by the ISO coefficient beside it, resistance from cycle to cycle,
/// force over speed or load. No blocks where it has nothing of these.
Section make_run_figures(const Json& result);

}  // namespace rollrig::report
