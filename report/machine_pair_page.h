#pragma once
/// The page of `rollrig diagnose --against`.

#include "include/rollrig/machine_pair.h"
#include "report/page.h"

namespace rollrig::report {

/// In which effect two machines differ, by how much their coefficients differ, and what remains with the effect.
Page make_machine_pair_page(const PairFindings& findings);

}  // namespace rollrig::report
