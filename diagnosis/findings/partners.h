#pragma once
/// What may act beside the first cause.

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// How much likelier a screened term makes what the fit leaves, averaged over its size.
/// Equation  B = sum over sizes of p(u) exp(x s - x^2 V/2), x = (size(u) - off)/(tried - off)
/// Symbols   u size in prior units, p its prior, cut off at its range; s and V score and variance of the signature of
///           the tried size (linear_fit.h); 1 where the signature is nothing, as the set says nothing of the term then
/// Validity  linear in the size; shapes held at the best of those tried
/// Checked   tests/diagnosis/partners_test.cpp
double calc_bayes_factor(const Screened& screened);

/// Fills acts, alone and partners of the first cause. Hypotheses with one effect more than the lead count with the
/// probability of their fit where they were fitted. Those that the set shows too little of to be fitted count with
/// their prior times calc_bayes_factor(): each is unlikely, all together are not.
/// Equation  P(with b) = P(lead) pi_(k+1)/pi_k B_b, over the sum of all; pi_k prior of each hypothesis of k effects
void find_partners(const Study& study, const Comparison& comparison, const Candidate& lead, rollrig::Cause& cause);

}  // namespace rollrig::diagnosis
