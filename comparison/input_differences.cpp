#include "comparison/input_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace rollrig::comparison {
namespace {

bool is_of_file(const std::string& key) { return key == "file" || key == "sha256"; }

std::string show_input(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

/// Dotted keys with their values; empty objects and lists have none.
void flatten(const Json& document, const std::string& prefix, std::vector<std::pair<std::string, Json>>& flat) {
  const auto add = [&](const std::string& key, const Json& value) {
    const std::string name = prefix.empty() ? key : prefix + "." + key;
    if (value.is_structured() && !value.empty()) {
      flatten(value, name, flat);
    } else if (!value.is_structured()) {
      flat.emplace_back(name, value);
    }
  };
  if (document.is_array()) {
    for (std::size_t i = 0; i < document.size(); ++i) add(std::to_string(i + 1), document[i]);
    return;
  }
  for (const auto& [key, value] : document.items()) {
    if (!is_of_file(key)) add(key, value);
  }
}

/// An input with its value in each of the documents that have it.
struct FoundInput {
  std::string name;
  std::vector<std::optional<Json>> values;
};

template <class Value>
bool are_all_equal(const std::vector<Value>& values) {
  return std::all_of(values.begin(), values.end(), [&values](const Value& value) { return value == values.front(); });
}

/// In six digits where these tell the values apart, else in all.
DifferentInput show_found(const FoundInput& found) {
  DifferentInput input{found.name, {}};
  for (const std::optional<Json>& value : found.values) {
    input.values.push_back(value.has_value() ? show_input(*value) : "");
  }
  if (!are_all_equal(input.values)) return input;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    if (found.values[i].has_value()) input.values[i] = found.values[i]->dump();
  }
  return input;
}

}  // namespace

std::vector<DifferentInput> find_different_inputs(const std::vector<const Json*>& documents,
                                                  const std::vector<std::string>& left_out) {
  std::vector<FoundInput> found;
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < documents.size(); ++i) {
    Json document = *documents[i];
    for (const std::string& key : left_out) document.erase(key);
    std::vector<std::pair<std::string, Json>> flat;
    flatten(document, "", flat);
    for (auto& [name, value] : flat) {
      const auto [place, is_new] = places.emplace(name, found.size());
      if (is_new) found.push_back({name, std::vector<std::optional<Json>>(documents.size())});
      found[place->second].values[i] = std::move(value);
    }
  }
  std::vector<DifferentInput> inputs;
  for (const FoundInput& one : found) {
    if (!are_all_equal(one.values)) inputs.push_back(show_found(one));
  }
  return inputs;
}

namespace {

void strip_files(Json& json) {
  if (!json.is_structured()) return;
  if (json.is_object()) {
    json.erase("file");
    json.erase("sha256");
  }
  for (Json& inner : json) strip_files(inner);
}

}  // namespace

Json strip_manifest(const Json& manifest) {
  Json stripped = manifest;
  for (const char* key : {"format", "rollrig", "integrator"}) stripped.erase(key);
  strip_files(stripped);
  return stripped;
}

}  // namespace rollrig::comparison
