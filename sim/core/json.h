#pragma once
/// JSON with keys in the order in which they were written.

#include <nlohmann/json.hpp>

#include <string>

namespace rollrig {

using Json = nlohmann::ordered_json;

/// A document as it is written to files.
inline std::string to_text(const Json& json) { return json.dump(2) + "\n"; }

}  // namespace rollrig
