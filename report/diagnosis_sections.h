#pragma once
/// Sections of a diagnosis page that follow from the diagnosis alone.

#include "diagnosis/diagnosis.h"
#include "report/page.h"

namespace rollrig::report {

Section make_verdict(const diagnosis::Diagnosis& diagnosis);
Section make_causes(const diagnosis::Diagnosis& diagnosis);
Section make_gap(const diagnosis::Diagnosis& diagnosis);
Block make_balance(const diagnosis::Diagnosis& diagnosis);
Section make_next(const diagnosis::Diagnosis& diagnosis);
/// Equation, source, priors of what is named and of what cannot be told from it.
Section make_explanations(const diagnosis::Diagnosis& diagnosis);

}  // namespace rollrig::report
