#pragma once
/// What may act beside the first cause.

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// Fills acts, alone and partners of the first cause, from the hypotheses that were fitted and those that were not.
/// Checked   tests/diagnosis/partners_test.cpp
void find_partners(const Comparison& comparison, const Candidate& lead, rollrig::Cause& cause);

}  // namespace rollrig::diagnosis
