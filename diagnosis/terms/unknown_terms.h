#pragma once
/// Families of unknown effects.

#include <vector>

#include "diagnosis/terms/term.h"

namespace rollrig::diagnosis {

/// What an effect outside the catalog may be like: a force in a band of speeds, a force by powers of speed and load,
/// a load that goes with speed, heat, gas that leaves, an error of the temperature reading. A hypothesis with one of
/// them counts as "unknown". What follows nothing recorded is the free discrepancy's (comparison/discrepancy.h).
/// Checked  tests/diagnosis/unknown_terms_test.cpp
std::vector<const Term*> list_unknown_terms();

}  // namespace rollrig::diagnosis
