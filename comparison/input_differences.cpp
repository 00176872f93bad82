#include "comparison/input_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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

/// Dotted keys with their values. An empty object or list is a value of its own.
void flatten(const Json& document, const std::string& prefix, std::vector<std::pair<std::string, std::string>>& flat) {
  const auto add = [&](const std::string& key, const Json& value) {
    const std::string name = prefix.empty() ? key : prefix + "." + key;
    if (value.is_structured() && !value.empty()) {
      flatten(value, name, flat);
    } else if (!value.is_structured()) {
      flat.emplace_back(name, show_input(value));
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

}  // namespace

std::vector<DifferentInput> find_different_inputs(const std::vector<const Json*>& documents,
                                                  const std::vector<std::string>& left_out) {
  std::vector<DifferentInput> inputs;
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < documents.size(); ++i) {
    Json document = *documents[i];
    for (const std::string& key : left_out) document.erase(key);
    std::vector<std::pair<std::string, std::string>> flat;
    flatten(document, "", flat);
    for (const auto& [name, value] : flat) {
      const auto [place, is_new] = places.emplace(name, inputs.size());
      if (is_new) inputs.push_back({name, std::vector<std::string>(documents.size())});
      inputs[place->second].values[i] = value;
    }
  }
  const auto is_same = [](const DifferentInput& input) {
    return std::all_of(input.values.begin(), input.values.end(),
                       [&input](const std::string& value) { return value == input.values.front(); });
  };
  inputs.erase(std::remove_if(inputs.begin(), inputs.end(), is_same), inputs.end());
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
