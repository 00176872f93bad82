#include "sim/core/config.h"

#include <deque>
#include <sstream>

#include <fmt/format.h>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/nesting.h"
#include "sim/core/text.h"

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

namespace rollrig {
namespace {

std::string text_of(const toml::node& node) {
  if (node.is_floating_point())
    return fmt::format("{}", node.as_floating_point()->get());  // 2.8, not 2.7999999999999998
  std::ostringstream out;
  node.visit([&out](const auto& n) { out << n; });
  return out.str();
}

ConfigValue convert_node(const toml::node& node, const std::string& file);

ConfigTable convert_table(const toml::table& table, const std::string& file) {
  ConfigTable result;
  result.origin = {file, static_cast<int>(table.source().begin.line)};
  for (const auto& [key, node] : table) {
    result.entries.emplace(std::string(key.str()), convert_node(node, file));
  }
  return result;
}

ConfigValue convert_node(const toml::node& node, const std::string& file) {
  ConfigValue value;
  value.origin = {file, static_cast<int>(node.source().begin.line)};
  if (const auto* table = node.as_table()) {
    value.data = convert_table(*table, file);
  } else if (const auto* array = node.as_array()) {
    ConfigArray items;
    for (const auto& item : *array) items.push_back(convert_node(item, file));
    value.data = std::move(items);
  } else {
    value.text = text_of(node);
    if (node.is_boolean()) {
      value.data = node.as_boolean()->get();
    } else if (node.is_integer()) {
      value.data = static_cast<double>(node.as_integer()->get());
    } else if (node.is_floating_point()) {
      value.data = node.as_floating_point()->get();
    } else {
      value.data = node.value<std::string>().value_or(value.text);  // dates are kept as their text
    }
  }
  return value;
}

ConfigValue parse_value(const std::string& text, const std::string& origin_name) {
  require_shallow(text, origin_name);
  try {
    const toml::table table = toml::parse("value = " + text);
    if (table.size() == 1) {
      ConfigValue value = convert_node(*table.get("value"), origin_name);
      value.origin = {origin_name, 0};
      return value;
    }
  } catch (const toml::parse_error&) {
    // not TOML: a bare word such as quasi_static, taken as a string below
  }
  return ConfigValue{text, {origin_name, 0}, text};
}

}  // namespace

const ConfigValue* ConfigTable::find(const std::string& key) const {
  const auto it = entries.find(key);
  return it == entries.end() ? nullptr : &it->second;
}

std::vector<std::string> ConfigTable::keys() const {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.first);
  return names;
}

ConfigTable parse_config(std::string_view text, const std::string& name) {
  require_shallow(text, name);
  try {
    ConfigTable table = convert_table(toml::parse(text, name), name);
    table.origin = {name, 1};
    return table;
  } catch (const toml::parse_error& error) {
    InputProblem problem;
    problem.what = fmt::format("not valid TOML: {}", error.description());
    problem.file = name;
    problem.line = static_cast<int>(error.source().begin.line);
    problem.allowed = "TOML 1.0: key = value lines under [table] headers";
    throw InputError(problem);
  }
}

ConfigTable read_config(const std::string& path) {
  struct Parsed {
    std::string path;
    std::string content;
    ConfigTable table;
  };
  // A campaign reads the same tire and rig for each of its runs, and parsing took a fifth of a quasi-static one.
  thread_local std::deque<Parsed> parsed;
  constexpr std::size_t kMost = 8;  // tire, rig, vehicle, sensors, a run file, and some to spare
  std::string content = read_text_file(path);
  for (const Parsed& known : parsed) {
    if (known.path == path && known.content == content) return known.table;
  }
  ConfigTable table = parse_config(content, path);
  if (parsed.size() == kMost) parsed.pop_front();
  parsed.push_back({path, std::move(content), table});
  return table;
}

void set_config_value(ConfigTable& root, const std::string& dotted_key, const std::string& value,
                      const std::string& origin_name) {
  std::vector<std::string> words;
  boost::algorithm::split(words, dotted_key, [](char c) { return c == '.'; });
  if (words.size() > kMostKeyParts) {
    throw InputError({"a key with too many parts", origin_name, 0, shorten(dotted_key, 60), shorten(value, 60),
                      fmt::format("at most {} parts with points between", kMostKeyParts), ""});
  }
  ConfigTable* table = &root;
  for (std::size_t i = 0; i < words.size(); ++i) {
    boost::algorithm::trim(words[i]);
    if (words[i].empty()) {
      throw InputError(
          {"a key has an empty part", origin_name, 0, dotted_key, value, "key=value or table.key=value", ""});
    }
    if (i + 1 == words.size()) {
      table->entries[words[i]] = parse_value(value, origin_name);
      return;
    }
    ConfigValue& next = table->entries[words[i]];
    if (next.as_table() == nullptr) {
      if (!next.text.empty() || next.as_array() != nullptr) {
        throw InputError(
            {fmt::format("'{}' is a value, not a table", words[i]), origin_name, 0, dotted_key, value, "", ""});
      }
      next.data = ConfigTable{{}, {origin_name, 0}};
      next.origin = {origin_name, 0};
    }
    table = &std::get<ConfigTable>(next.data);
  }
}

}  // namespace rollrig
