#pragma once
/// What a hypothesis says of a run that its fit did not see.

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// What a hypothesis, fitted without one run, says of every run.
struct Prediction {
  Eigen::VectorXd simulated;  // empty where it cannot be simulated
  double uncertainty = 0.0;   // of the run left out: sum of the squares of its standard deviations, whitened
};

/// One step of Gauss and Newton within bounds from the fit to all runs, whose derivatives are known; the prediction is
/// simulated.
/// Equation  minimum of |r + J (u - u_0)|^2 + |u|^2 over the rows of all other runs
/// Bounds    own parameters within their ranges, base parameters within 0.9 of their value (Assumed)
/// Symbols   r whitened residuals of the fit to all runs at its unknowns u_0, J their derivatives, u in prior units
/// Checked   tests/diagnosis/gap_test.cpp
Prediction predict_without(const Study& study, const Candidate& candidate, std::size_t held_out);

}  // namespace rollrig::diagnosis
