#pragma once
/// Hypotheses that were screened and not fitted: each is unlikely, all together are not.

#include <string>
#include <vector>

#include "diagnosis/comparison/screen.h"

namespace rollrig::diagnosis {

struct Comparison;

/// A hypothesis that was not fitted.
struct Unfitted {
  std::vector<std::string> names;  // of its effects
  double probability = 0.0;

  bool contains(const std::string& name) const;
};

/// How much likelier a screened term makes what the fit leaves, averaged over its size.
/// Equation  B = sum over sizes of p(u) exp(x s - x^2 V/2), x = (size(u) - off)/(tried - off)
/// Symbols   u size in prior units, p its prior, cut off at its range; s and V score and variance of the signature of
///           the tried size (linear_fit.h); 1 where the signature is nothing, as the set says nothing of the term then
/// Validity  linear in the size; shapes held at the best of those tried
/// Checked   tests/diagnosis/unfitted_test.cpp
double calc_bayes_factor(const Screened& screened);

/// Hypotheses with one effect more than the baseline, or than a hypothesis on top of which effects were screened, that
/// were not fitted themselves.
/// Equation  P(with b) = pi_(k+1)/pi_k ((P - L) min(B_b, e^3) + L min(B_b, 1)); pi_k prior of each hypothesis of k
///           effects
/// Symbols   P probability of the hypothesis on top of which b was screened; L part of it that came from hypotheses
///           with one effect more, as errors of the law (Candidate::of_law_error); e^3: a term that gains more was
///           fitted, or others that gain more than it were (thresholds.h, kWorthAdding_nats)
std::vector<Unfitted> list_unfitted(const Study& study, const Comparison& comparison);

/// Their probabilities together.
double sum_probability(const std::vector<Unfitted>& unfitted);

}  // namespace rollrig::diagnosis
