#pragma once
/// Whether the tire of a set's file can be the one that was measured.

#include <string>
#include <vector>

#include "diagnosis/checks/plausibility.h"

namespace rollrig::diagnosis {

/// Warnings, a sentence each: load or cold pressure far from those at which the tire was identified; loss
/// under load more than 15 % off the file's; another tire of the assets, of another size, whose sum of
/// squares (RunMisfit) is less than 0.15 of that of the set's.
/// Validity  a hint, no proof: an effect can move the loss as another tire does, and a tire that is not
///           among the assets is not known
/// Source    Assumed: all limits
/// Checked   tests/diagnosis/set_checks_test.cpp
std::vector<std::string> check_tire(const measurements::MeasurementSet& set, const BaselineRuns& baseline, int threads);

/// Those of load and cold pressure alone, which need no simulation.
std::vector<std::string> check_tire_conditions(const measurements::MeasurementSet& set);

}  // namespace rollrig::diagnosis
