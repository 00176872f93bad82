#pragma once
/// Which hypotheses a measured set leaves open.

#include <vector>

#include "diagnosis/comparison/model_comparison.h"

namespace rollrig::diagnosis {

/// A hypothesis that may be true, and what is known of its parameters.
struct OpenHypothesis {
  Hypothesis hypothesis;
  Eigen::VectorXd parameters;  // own, then base, prior units
  Eigen::MatrixXd spread;      // L of their covariance L L^T after the measurement
  double probability = 0.0;    // all add to 1
};

/// The likeliest hypothesis with, in this order and at most six in all (nine where it is the baseline),
/// - unless it is the baseline, those that the set cannot tell from it (verdict.h), all as likely as it: that is the
///   question to be split,
/// - the runners-up from a probability of 0.01,
/// - where that leaves nothing but it, or where it is the baseline: it with one more term whose detectability in this
///   set is below 3 standard deviations (Assumed), at the middle of its prior, as uncertain as the set leaves it.
/// No hypothesis counts for less than a twentieth of the likeliest. One sign of a term stands for both.
/// Source  Assumed: six, nine, a twentieth and 0.01, which keep what matters in a named set of at most three
/// Checked tests/diagnosis/next_test_test.cpp
std::vector<OpenHypothesis> find_open_hypotheses(const Study& study, const Comparison& comparison);

}  // namespace rollrig::diagnosis
