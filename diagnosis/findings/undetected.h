#pragma once
/// What a verdict without a gap is worth.

#include "diagnosis/comparison/model_comparison.h"

namespace rollrig::diagnosis {

/// Probability that no effect acts that this set would show: none at all, or one that is too small for it.
/// Equation  P(none) + sum over hypotheses of P(h) P(d' < 5 | h);  d' = d'_1 |s/s_1|
/// Symbols   d' how clearly the set shows an effect, in standard deviations; d'_1 at the size s_1 at which it was
///           screened; s the size, with its prior and the likelihood that the screen gives it, to first order. Of a
///           hypothesis with several effects, the one that shows most clearly counts
/// Checked   tests/diagnosis/undetected_test.cpp
double calc_nothing_detectable(const Study& study, const Comparison& comparison);

}  // namespace rollrig::diagnosis
