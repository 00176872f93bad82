#pragma once
/// JSON with keys in the order in which they were written.

#include <nlohmann/json.hpp>

namespace rollrig {
using Json = nlohmann::ordered_json;
}  // namespace rollrig
