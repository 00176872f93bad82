#pragma once
/// The lead: the hypothesis after which the first cause is named.

#include <map>
#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"

namespace rollrig::diagnosis {

/// What a set like this one would say on average for `a` against `b`, were `a` true.
/// Equation  |Sigma^-1/2 (r_a - r_b)|^2 / 2, r the whitened residuals of the two fits
double expected_log_bayes_factor(const Study& study, const Candidate& a, const Candidate& b);

/// What is named beside the lead's own effects, in the order of the names: all of `beside` (with what is left of their
/// probability), or where that makes more than three in all, without the unlikeliest, as long as all that are left out
/// have together at most a tenth of the probability of the lead and all of `beside`.
std::vector<std::string> find_named_beside(const std::vector<std::string>& lead, double lead_weight,
                                           std::map<std::string, double> beside);

/// Whether the measurement left a hypothesis open beside the lead: one that predicts the same, but only with parameters
/// that are most unusual, is told from it already.
bool is_open_beside(const Candidate& lead, const Candidate& other);

/// Whether the set tells two hypotheses apart: expected log Bayes factor of 3 or more.
bool is_told_apart(const Study& study, const Candidate& lead, const Candidate& other);

/// All hypotheses with effects of the catalog: those that were fitted, the likeliest first, and the others.
struct NamedHypotheses {
  std::vector<const Candidate*> fitted;
  const std::vector<Unfitted>& unfitted;
};

/// The lead where this hypothesis is the likeliest. A hypothesis passes if each of its effects acts with at least half
/// of the probability that any of them acts (the median probability model). Hypotheses of as many effects that the set
/// cannot tell from it count as if they had its effects, unless all their effects together are too many to be named.
/// The lead is, in this order: the likeliest hypothesis that has one effect more, if it passes; the given one, if it
/// passes; what follows in the same way from the one with only those of its effects that are likely enough; the given
/// one where that was not fitted.
/// Checked  tests/diagnosis/lead_test.cpp
const Candidate* choose_lead(const Study& study, const NamedHypotheses& all, const Candidate& likeliest);

}  // namespace rollrig::diagnosis
