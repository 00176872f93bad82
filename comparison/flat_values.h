#pragma once
/// Results of several runs, flattened to one number a key (scenarios::flatten_results), as values of a comparison.

#include <optional>
#include <string>
#include <vector>

#include "comparison/compared.h"
#include "scenarios/run/scenario.h"
#include "sim/core/json.h"

namespace rollrig::comparison {

/// RRc at 25 degC on the 2 m drum: what a reader looks for first.
constexpr const char* kMainResult = "rrc_25degC_2m_N_per_kN";

/// The number of a key; none where it has none.
std::optional<double> find_number(const Json& flat, const std::string& key);

/// Keys of all, each once, in the order in which they come.
std::vector<std::string> list_keys(const std::vector<Json>& flat);

/// Results of all by one key with what the scenario says of it, and their differences without intervals. `scenario` may
/// be null, where this program has none of that name.
ComparedValue make_value(const std::string& key, const std::vector<Json>& flat, const scenarios::Scenario* scenario);

}  // namespace rollrig::comparison
