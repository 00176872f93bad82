#include "comparison/flat_values.h"

#include <set>

#include "sim/core/units.h"

namespace rollrig::comparison {
namespace {

std::string find_doc(const scenarios::Scenario* scenario, const std::string& key) {
  if (scenario == nullptr) return "";
  for (const scenarios::ResultInfo& info : scenario->results) {
    if (info.key == scenarios::find_declared_key(key)) return info.doc;
  }
  return "";
}

}  // namespace

std::optional<double> find_number(const Json& flat, const std::string& key) {
  const auto found = flat.find(key);
  return found != flat.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

std::vector<std::string> list_keys(const std::vector<Json>& flat) {
  std::vector<std::string> keys;
  std::set<std::string> known;
  for (const Json& of : flat) {
    for (const auto& [key, value] : of.items()) {
      if (known.insert(key).second) keys.push_back(key);
    }
  }
  return keys;
}

ComparedValue make_value(const std::string& key, const std::vector<Json>& flat, const scenarios::Scenario* scenario) {
  ComparedValue value;
  value.name = key;
  value.label = label_result(key);
  value.unit = unit_of_key(key.substr(key.rfind('.') + 1)).symbol;
  value.doc = find_doc(scenario, key);
  for (const Json& of : flat) value.values.push_back(find_number(of, key));
  for (std::size_t i = 1; i < flat.size(); ++i) {
    value.differences.push_back(subtract(value.values[i], value.values.front(), value.unit));
  }
  return value;
}

}  // namespace rollrig::comparison
