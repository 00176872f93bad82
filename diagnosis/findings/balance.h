#pragma once
/// Which equation needs a perturbation for the simulation to meet the measurement.

#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// Shares of the perturbations (perturbations.h) in what the recalibrated baseline leaves, the largest first; those
/// below 1 % are dropped. Empty where perturbations are not a hundred times as likely as none: under the baseline that
/// happens in 1 % of sets at most.
///
/// Every perturbation is normal around 0 before the measurement, with an amplitude of its family's own; base parameters
/// and offsets are integrated out. The families that act and their amplitudes are searched by evidence, and shares
/// averaged over the best set of families and all that differ from it by one family or amplitude.
///
/// A heat perturbation and a temperature sensor's own perturbation move the liner's temperature alike. They differ in
/// what follows: heat also lowers the loss and, later, raises the pressure; where that is within the noise they share.
/// So do perturbations that are twins on a set: "boundary" and "tire heat" at one speed, "drum torque" with "tire heat"
/// and "tire loss". The torque sensor is part of "drum torque".
///
/// Equation  r = sum_f X_f a_f + noise, a_f ~ N(0, (s_f c_f)^2), c_f: a constant perturbation of it moves some channel
///           by one noise floor (rms over the set); ln Z = 1/2 b^T (Q + S^-1)^-1 b - 1/2 ln |1 + S^1/2 Q S^1/2|,
///           Q = X^T C^-1 X, b = X^T C^-1 r;  share of f = max(0, a_f.b_f)/sum
/// Symbols   r measured - simulated, C covariance of noise, discrepancy, base parameters and offsets, S of the
///           perturbations
/// Source    evidence of a linear model; Markov's inequality for a ratio of evidences (sets without a gap).
///           Assumed: no perturbation is as likely as any beforehand, all families are alike, s from 0.5 to 256
/// Errors    RunFailure: a run cannot be simulated at the null
/// Checked   tests/diagnosis/balance_test.cpp
std::vector<BalanceShare> find_balance(const Study& study);

}  // namespace rollrig::diagnosis
