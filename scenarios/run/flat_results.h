#pragma once
/// Results of several runs of one scenario as single numbers, for the columns of a sweep.

#include <map>
#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::scenarios {

/// Makes of each of several results an object of numbers alone: first those that stand alone, then those of lists, in
/// order.
///
/// The key of a number in a list contains the list and the record: "sections.city_1.rr_energy_Wh" where the records
/// have names that are the same in all results, else their place, from 1: "cycles.1.load_N". A flag is 1 or 0. Texts
/// and what has no value are left out.
/// Checked  tests/scenarios/flat_results_test.cpp
class ResultFlattener {
 public:
  /// To be called with each of the results before the first is flattened.
  void learn_names(const Json& result);
  Json flatten(const Json& result) const;

 private:
  std::map<std::string, std::vector<std::string>> names_;  // of the records of each list; none where they are numbered
};

/// All of them.
std::vector<Json> flatten_results(const std::vector<Json>& results);

/// The declared key of a flat one: "cycles[].load_N" of "cycles.1.load_N".
std::string find_declared_key(const std::string& flat_key);

}  // namespace rollrig::scenarios
