#pragma once
/// The regression on speed traces as generalized least squares, with the scatter of runs and of sessions.

#include <string>
#include <vector>

#include "estimation/road_load/variance_components.h"

namespace rollrig::estimation {

/// Kinds of scatter within a block, that is, a run: of speeds, along the run, from run to run (constant; in proportion
/// to speed, where the regression has B).
enum TraceScatter : Eigen::Index { kSpeedNoise, kWhiteForce, kForceOfRun, kSlopeOfRun, kTraceComponents };

struct TraceFit {
  LinearEstimate estimate;
  double session_force_N = 0.0;   // scatter from session to session, the same at all speeds, or
  double session_share = 0.0;     // the same share of the force; at least one of the two is 0
  bool sessions_are_told = true;  // false: a session is a heading, and how sessions differ is not in the intervals
};

/// Coefficients and components of variance, a block for each run. If there are several
/// sessions, and one of them has two runs or more, sessions scatter as well: by a force that is the same at all speeds,
/// or by a share of the force where that is clearly more likely.
/// Equation  V = D + s f f' for the runs of a session, D by the components of the runs
/// Symbols   s variance between sessions; f ones, or forces of the fit [N]; `sessions`: name of that of each block
/// Method    D from a fit in which each session has a term of this shape; s by the restricted likelihood with that D
/// Checked   tests/estimation/anemometer_test.cpp, tests/estimation/session_differences_test.cpp
TraceFit fit_trace_blocks(const std::vector<LinearBlock>& blocks, const std::vector<std::string>& sessions);

}  // namespace rollrig::estimation
