#pragma once
/// JSON with keys in the order in which they were written.

#include <nlohmann/json.hpp>

#include <string>

namespace rollrig {

using Json = nlohmann::ordered_json;

/// A document as it is written to files.
inline std::string to_text(const Json& json) { return json.dump(2) + "\n"; }

/// A list of what `convert` makes of each item; [] where there is none.
template <class Items, class Convert>
Json make_list(const Items& items, Convert&& convert) {
  Json json = Json::array();
  for (const auto& item : items) json.push_back(convert(item));
  return json;
}

}  // namespace rollrig
