#include "scenarios/run/flat_results.h"

#include <cctype>
#include <set>

namespace rollrig::scenarios {
namespace {

/// Names of the records of a list; none where a record has no name, or where two have the same one.
using Names = std::vector<std::string>;

/// "constant_speed_105_km_h_end" of "constant speed 105 km/h, end".
std::string make_key(const std::string& name) {
  std::string key;
  for (const char letter : name) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
      key += letter;
    } else if (!key.empty() && key.back() != '_') {
      key += '_';
    }
  }
  while (!key.empty() && key.back() == '_') key.pop_back();
  return key;
}

Names list_names(const Json& list) {
  Names names;
  std::set<std::string> taken;
  for (const Json& record : list) {
    const Json name = record.is_object() ? record.value("name", Json()) : Json();
    names.push_back(name.is_string() ? make_key(name.get<std::string>()) : "");
    if (names.back().empty() || !taken.insert(names.back()).second) return {};
  }
  return names;
}

void add_flat_numbers(const std::string& key, const Json& value, Json& flat) {
  if (value.is_number()) flat[key] = value;
  if (value.is_boolean()) flat[key] = value.get<bool>() ? 1 : 0;
  if (value.is_object()) {
    for (const auto& [member, inner] : value.items()) add_flat_numbers(key + "." + member, inner, flat);
  }
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) add_flat_numbers(key + "." + std::to_string(i + 1), value[i], flat);
  }
}

}  // namespace

void ResultFlattener::learn_names(const Json& result) {
  for (const auto& [key, value] : result.items()) {
    if (!value.is_array()) continue;
    const Names names = list_names(value);
    const auto [known, is_new] = names_.emplace(key, names);
    if (!is_new && known->second != names) known->second.clear();
  }
}

Json ResultFlattener::flatten(const Json& result) const {
  Json flat = Json::object();
  for (const auto& [key, value] : result.items()) {
    if (!value.is_structured()) add_flat_numbers(key, value, flat);
  }
  for (const auto& [key, value] : result.items()) {
    const auto named = names_.find(key);
    if (named == names_.end() || named->second.empty()) {
      if (value.is_structured()) add_flat_numbers(key, value, flat);
      continue;
    }
    for (std::size_t i = 0; i < value.size(); ++i) add_flat_numbers(key + "." + named->second[i], value[i], flat);
  }
  return flat;
}

std::vector<Json> flatten_results(const std::vector<Json>& results) {
  ResultFlattener flattener;
  for (const Json& result : results) flattener.learn_names(result);
  std::vector<Json> flat;
  for (const Json& result : results) flat.push_back(flattener.flatten(result));
  return flat;
}

std::string find_declared_key(const std::string& flat_key) {
  const std::size_t first = flat_key.find('.');
  const std::size_t last = flat_key.rfind('.');
  if (first == last) return flat_key;
  return flat_key.substr(0, first) + "[]" + flat_key.substr(last);
}

}  // namespace rollrig::scenarios
