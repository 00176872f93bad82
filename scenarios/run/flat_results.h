#pragma once
/// Results of several runs of one scenario as single numbers, for the columns of a sweep.

#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::scenarios {

/// Each result as an object of numbers alone: first those that stand alone, then those of lists, in order.
///
/// The key of a number in a list contains the list and the record: "sections.city_1.rr_energy_Wh" where the records
/// have names that are the same in all runs, else their place, from 1: "cycles.1.load_N". A flag is 1 or 0. Texts and
/// what has no value are left out.
/// Checked  tests/scenarios/flat_results_test.cpp
std::vector<Json> flatten_results(const std::vector<Json>& results);

/// The declared key of a flat one: "cycles[].load_N" of "cycles.1.load_N".
std::string find_declared_key(const std::string& flat_key);

}  // namespace rollrig::scenarios
