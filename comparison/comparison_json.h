#pragma once
/// A comparison as JSON and CSV.

#include <string>

#include "include/rollrig/compare.h"
#include "sim/core/json.h"

namespace rollrig::comparison {

/// The document of a comparison (rollrig-comparison/1).
Json make_comparison_json(const Comparison& comparison);

/// A row for each value and each of the compared but the reference.
std::string make_differences_csv(const Comparison& comparison);

/// "results", "measurement sets", "tires".
const char* name_of(ComparedKind kind);

}  // namespace rollrig::comparison
