#pragma once
/// The iteration of a road-load fit: coefficients and components of variance together.

#include <optional>

#include "estimation/road_load/coastdown_problem.h"
#include "estimation/road_load/road_load_fit.h"

namespace rollrig::estimation {

struct IterationStart {
  Eigen::VectorXd coefficients;
  Eigen::VectorXd components;  // of variance, by CoastdownScatter
};

enum class Components { kEstimated, kHeld };

struct IteratedFit {
  LinearEstimate linear;
  LinearEstimate unbounded;  // the same without bounds
  Eigen::VectorXd coefficients;
  Eigen::VectorXd components;
  int iterations = 0;
  bool components_settled = true;
};

/// Linearizes about the present coefficients, solves the weighted problem, and repeats until nothing changes by more
/// than 1e-4 of its standard deviation (1e-3 where the components are held). Each component is settled when it changes
/// by less than 1e-3 of itself. From the 11th turn on all steps are halved, and after 50 turns the components stay as
/// they are; `components_settled` says whether they would not move by more than a tenth of themselves then.
/// Errors    RunFailure: the force would not stay positive, or 200 iterations are not enough
IteratedFit iterate_road_load(const CoastdownProblem& problem, const std::optional<RoadLoadBounds>& bounds,
                              const IterationStart& start, Components kind);

}  // namespace rollrig::estimation
