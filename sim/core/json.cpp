#include "sim/core/json.h"

#include <cmath>

#include <fmt/format.h>

#include "sim/core/error.h"

namespace rollrig {
namespace {

void require_finite(const Json& json, const std::string& key) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) {
    throw RunFailure(
        fmt::format("the result '{}' is no number ({}), so nothing is written", key.substr(1), json.get<double>()));
  }
  if (!json.is_structured()) return;
  std::size_t item = 0;
  for (const auto& [name, value] : json.items()) {
    ++item;
    require_finite(value, key + "." + (json.is_array() ? std::to_string(item) : name));
  }
}

}  // namespace

std::string to_text(const Json& json, int indent) {
  require_finite(json, "");
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rollrig
