#pragma once
/// Conditions of a run that no other run of the set has.

#include <string>
#include <vector>

#include "diagnosis/comparison/prepared_set.h"

namespace rollrig::diagnosis {

/// Conditions of a run that no other run comes near, in words: "load", "speed", "pressure", "start temperature", "air
/// temperature", "speed changes". Empty if the other runs have all of them.
///
/// Near      Assumed: load within 10 %, speed within 10 km/h, pressure within 10 kPa, temperatures within 5 K; load,
///           speed and air temperature as means of phases
/// Checked   tests/diagnosis/lone_conditions_test.cpp
std::vector<std::string> find_lone_conditions(const PreparedSet& set, std::size_t run);

}  // namespace rollrig::diagnosis
