#pragma once
/// JSON with keys in the order in which they were written.

#include <nlohmann/json.hpp>

#include <string>

namespace rollrig {

using Json = nlohmann::ordered_json;

/// A document as it is written to files. Bytes that are no UTF-8, such as those of a path, become U+FFFD.
/// Errors  RunFailure: a number that is not finite, with its key; what may lack a value is null instead
std::string to_text(const Json& json, int indent = 2);

/// A list of what `convert` makes of each item; [] where there is none.
template <class Items, class Convert>
Json make_list(const Items& items, Convert&& convert) {
  Json json = Json::array();
  for (const auto& item : items) json.push_back(convert(item));
  return json;
}

}  // namespace rollrig
