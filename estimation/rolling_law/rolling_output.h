#pragma once
/// The files of `rollrig fit j2452` and `fit j1269`.

#include <optional>

#include "estimation/rolling_law/j1269_fit.h"
#include "estimation/rolling_law/j2452_fit.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

/// Mean forces over drives, at the reference condition.
struct CycleForces {
  std::string urban_cycle;
  std::string highway_cycle;
  SpeedMoments urban;
  SpeedMoments highway;
};

/// What a fit says of the tire at its reference condition.
struct J2452Reference {
  ReferenceCondition condition;
  ForceEstimate force;  // at 80 km/h
  ForceEstimate urban;  // MERF
  ForceEstimate highway;
  ForceEstimate combined;  // SMERF
  CycleForces cycles;
};

J2452Reference evaluate_reference(const J2452Fit& fit, const ReferenceCondition& at, const CycleForces& cycles);

struct MultipointReference {
  ReferenceCondition condition;
  ForceEstimate force;
};

Json make_j2452_json(const RollingTest& test, const J2452Fit& fit, const std::optional<J2452Reference>& reference);
Json make_multipoint_json(const RollingTest& test, const MultipointFit& fit,
                          const std::optional<MultipointReference>& reference);
/// Every point with what is left of it.
std::string write_rolling_residuals(const std::vector<FittedPoint>& points);

}  // namespace rollrig::estimation
