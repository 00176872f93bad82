#include "exports/tree.h"

#include <algorithm>
#include <limits>

namespace rollrig::exports {
namespace {

bool is_number(const Json& json) { return json.is_number() || json.is_null(); }

double to_number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

template <class Test>
bool all_items(const Json& array, const Test& test) {
  return std::all_of(array.begin(), array.end(), test);
}

Column make_column(const Json& array) {
  Column column;
  for (const Json& item : array) column.push_back(to_number(item));
  return column;
}

/// The values under one key of an array of objects.
Json collect(const Json& array, const std::string& key) {
  Json values = Json::array();
  for (const Json& item : array) values.push_back(item.at(key));
  return values;
}

bool is_column(const Json& array) { return all_items(array, is_number); }
bool is_texts(const Json& array) {
  return all_items(array, [](const Json& item) { return item.is_string(); });
}

bool is_table(const Json& array) {
  const Json& first = array.front();
  const auto is_alike = [&first](const Json& item) {
    if (!item.is_object() || item.empty() || item.size() != first.size()) return false;
    return std::all_of(item.items().begin(), item.items().end(),
                       [&first](const auto& member) { return first.contains(member.key()); });
  };
  if (!all_items(array, is_alike)) return false;
  return std::all_of(first.items().begin(), first.items().end(), [&array](const auto& member) {
    const Json values = collect(array, member.key());
    return is_column(values) || is_texts(values);
  });
}

Node make_array(const Json& array) {
  if (is_column(array)) return {make_column(array)};
  if (is_texts(array)) return {array.get<Texts>()};
  if (is_table(array)) {
    Group table;
    table.is_table = true;
    for (const auto& member : array.front().items()) table.add(member.key(), make_array(collect(array, member.key())));
    return {table};
  }
  List list;
  for (const Json& item : array) list.items.push_back(make_node(item));
  return {list};
}

Json to_json(const ConfigValue& value) {
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag;
  if (const auto* number = std::get_if<double>(&value.data)) return *number;
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
  Json json;
  if (const ConfigArray* array = value.as_array()) {
    json = Json::array();
    for (const ConfigValue& item : *array) json.push_back(to_json(item));
  }
  if (const ConfigTable* table = value.as_table()) {
    json = Json::object();
    for (const auto& [key, entry] : table->entries) json[key] = to_json(entry);
  }
  return json;
}

}  // namespace

void Group::add(const std::string& name, Node node) { members.emplace_back(name, std::move(node)); }

Node make_node(const Json& json) {
  if (is_number(json)) return {to_number(json)};
  if (json.is_boolean()) return {json.get<bool>()};
  if (json.is_string()) return {json.get<std::string>()};
  if (json.is_array()) return make_array(json);
  Group group;
  for (const auto& member : json.items()) group.add(member.key(), make_node(member.value()));
  return {group};
}

Node make_node(const ConfigTable& table) { return make_node(to_json(ConfigValue{table, {}, ""})); }

std::string take_name(const std::string& name, std::set<std::string>& taken) {
  std::string unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
  return unique;
}

}  // namespace rollrig::exports
