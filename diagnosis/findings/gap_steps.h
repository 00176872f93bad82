#pragma once
/// The gap from the files' numbers to the first cause, one step after the other.

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// What is left with the files' numbers, after a recalibration, and after each effect of `lead` has been added to those
/// before it, in its order (null: no effect). With every effect all unknowns are fitted again, to all runs, and the
/// gap is that on the fitted data. Empty where the set cannot be simulated with the files' numbers.
///
/// Equation  as in gap.h: root of the mean square of the differences without noise
/// Validity  where effects overlap, the first of them takes what both could
/// Checked   tests/diagnosis/gap_steps_test.cpp
std::vector<GapStep> find_gap_steps(const Study& study, const Comparison& comparison, const Candidate* lead);

}  // namespace rollrig::diagnosis
