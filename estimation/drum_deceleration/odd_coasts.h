#pragma once
/// Coasts that do not agree with the others of their kind.

#include <vector>

#include "estimation/drum_deceleration/coast_curves.h"
#include "estimation/drum_deceleration/coast_doubts.h"

namespace rollrig::estimation {

/// Adds the odd runs among those that are not set aside (see check_coasts()), and sets them aside.
void add_odd_coasts(const CoastSet& set, const std::vector<CoastCurve>& curves, CoastDoubts& checked);

}  // namespace rollrig::estimation
