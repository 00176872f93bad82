#pragma once
/// Sections of a diagnosis page that follow from the diagnosis alone.

#include "include/rollrig/findings.h"
#include "report/page.h"

namespace rollrig::report {

Section make_verdict(const Findings& findings);
Section make_causes(const Findings& findings);
Section make_gap(const Findings& findings);
Block make_balance(const Findings& findings);
Section make_next(const Findings& findings);
/// Equation, source, priors of what is named and of what cannot be told from it.
Section make_explanations(const Findings& findings);

}  // namespace rollrig::report
