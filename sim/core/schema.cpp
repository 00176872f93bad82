#include "sim/core/schema.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <boost/algorithm/string/join.hpp>

#include "sim/core/error.h"

namespace rollrig {
namespace {

/// With its article.
const char* kind_of(const ConfigValue& value) {
  static constexpr const char* kKinds[] = {"true or false", "a number", "a string", "an array", "a table"};
  return kKinds[value.data.index()];
}

std::string allowed_number(const Field& field) {
  const Unit unit = unit_of_key(field.key);
  std::string text = "a number";
  const std::string range = field.range.to_string();
  if (!range.empty()) text += " " + range;
  if (!unit.symbol.empty()) text += ", in " + unit.symbol;
  return text;
}

}  // namespace

TableReader::TableReader(const ConfigTable& table, std::string name) : table_(table), name_(std::move(name)) {}

std::string TableReader::full_key(const std::string& key) const { return name_.empty() ? key : name_ + " " + key; }

InputError TableReader::problem(const std::string& key, const std::string& what, const std::string& allowed) const {
  const ConfigValue* value = table_.find(key);
  const Origin& origin = value != nullptr ? value->origin : table_.origin;
  return InputError({what, origin.file, origin.line, full_key(key), value != nullptr ? value->text : "", allowed, ""});
}

bool TableReader::has(const std::string& key) const { return table_.find(key) != nullptr; }

const ConfigValue* TableReader::find(const std::string& key) {
  known_.push_back(key);
  return table_.find(key);
}

const ConfigValue& TableReader::require(const std::string& key) {
  const ConfigValue* value = find(key);
  if (value != nullptr) return *value;
  InputProblem missing{
      fmt::format("missing key '{}'", key), table_.origin.file, table_.origin.line, full_key(key), "", "", ""};
  std::vector<std::string> others = table_.keys();  // an uncertainty beside a number that is not there is in its place
  others.erase(std::remove(others.begin(), others.end(), key + "_sd"), others.end());
  const std::string nearest = nearest_name(key, others);
  if (!nearest.empty()) missing.nearest = fmt::format("'{}' is there; is it meant?", nearest);
  throw InputError(missing);
}

double TableReader::convert(const Field& field, const ConfigValue& value) const {
  const double* number = std::get_if<double>(&value.data);
  if (number == nullptr) {
    throw problem(field.key, fmt::format("'{}' must be a number, not {}", field.key, kind_of(value)),
                  allowed_number(field));
  }
  if (!std::isfinite(*number)) {
    throw problem(field.key, fmt::format("'{}' is not finite", field.key), allowed_number(field));
  }
  if (!field.range.contains(*number)) {
    throw problem(field.key, fmt::format("'{}' is out of range", field.key), allowed_number(field));
  }
  return unit_of_key(field.key).to_si(*number);
}

double TableReader::number(const Field& declared) {
  const std::optional<double> given = number_or_none(declared);
  if (given.has_value()) return *given;
  if (!declared.fallback.has_value()) require(declared.key);
  return unit_of_key(declared.key).to_si(*declared.fallback);
}

std::optional<double> TableReader::number_or_none(const Field& declared) {
  Field field = declared;
  const ConfigValue* value = find(field.key);
  const bool has_old_key = field.old_key != nullptr && std::string(field.old_key) != field.key;
  if (const ConfigValue* old = has_old_key ? find(field.old_key) : nullptr) {
    const auto is_given_by_run = [this](const ConfigValue& at) { return at.origin.file != table_.origin.file; };
    if (value != nullptr && is_given_by_run(*old) == is_given_by_run(*value)) {
      throw problem(field.old_key, fmt::format("'{}' and '{}' are one number", field.old_key, field.key),
                    "one of them");
    }
    if (value == nullptr || is_given_by_run(*old)) {
      value = old;
      field.key = field.old_key;
    }
  }
  if (value == nullptr) return std::nullopt;
  return convert(field, *value);
}

std::vector<double> TableReader::numbers_or(const Field& field, const std::vector<double>& fallback) {
  const ConfigValue* value = find(field.key);
  if (value == nullptr) return fallback;
  const ConfigArray* array = value->as_array();
  if (array == nullptr || array->empty()) {
    const char* kind = array == nullptr ? kind_of(*value) : "an empty one";
    throw problem(field.key, fmt::format("'{}' must be a list of numbers, not {}", field.key, kind),
                  fmt::format("{} = [1.0, 2.0], each {}", field.key, allowed_number(field)));
  }
  std::vector<double> numbers;
  for (const ConfigValue& item : *array) numbers.push_back(convert(field, item));
  return numbers;
}

int TableReader::count(const Field& field) {
  const double value = number(field);
  if (value != std::floor(value)) {
    throw problem(field.key, fmt::format("'{}' must be a whole number", field.key), allowed_number(field));
  }
  constexpr int kMost = std::numeric_limits<int>::max();
  if (std::abs(value) > kMost) {
    throw problem(field.key, fmt::format("'{}' is too large", field.key), fmt::format("at most {}", kMost));
  }
  return static_cast<int>(value);
}

std::string TableReader::text(const std::string& key, const std::vector<std::string>& choices) {
  const ConfigValue& value = require(key);
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) {
    throw problem(key, fmt::format("'{}' must be a string, not {}", key, kind_of(value)), "a string in quotes");
  }
  if (!choices.empty() && std::find(choices.begin(), choices.end(), *text) == choices.end()) {
    InputProblem unknown = unknown_name(key, *text, choices);
    unknown.file = value.origin.file;
    unknown.line = value.origin.line;
    unknown.key = full_key(key);
    throw InputError(unknown);
  }
  return *text;
}

std::string TableReader::text_or(const std::string& key, const std::string& fallback,
                                 const std::vector<std::string>& choices) {
  if (!has(key)) {
    accept(key);
    return fallback;
  }
  return text(key, choices);
}

bool TableReader::flag_or(const std::string& key, bool fallback) {
  const ConfigValue* value = find(key);
  if (value == nullptr) return fallback;
  const bool* flag = std::get_if<bool>(&value->data);
  if (flag == nullptr) {
    throw problem(key, fmt::format("'{}' must be true or false, not {}", key, kind_of(*value)), "true or false");
  }
  return *flag;
}

const ConfigTable* TableReader::table(const std::string& key) {
  const ConfigValue* value = find(key);
  if (value == nullptr) return nullptr;
  if (value->as_table() == nullptr) {
    throw problem(key, fmt::format("'{}' must be a table, not {}", key, kind_of(*value)), fmt::format("[{}]", key));
  }
  return value->as_table();
}

std::vector<const ConfigTable*> TableReader::tables(const std::string& key) {
  const ConfigValue* value = find(key);
  if (value == nullptr) return {};
  std::vector<const ConfigTable*> result;
  if (const ConfigArray* array = value->as_array()) {
    for (const ConfigValue& item : *array) result.push_back(item.as_table());
  }
  const bool all_tables = !result.empty() && std::find(result.begin(), result.end(), nullptr) == result.end();
  if (!all_tables) {
    throw problem(key, fmt::format("'{}' must be an array of tables", key), fmt::format("[[{}]]", key));
  }
  return result;
}

void TableReader::finish() const {
  for (const auto& [key, value] : table_.entries) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    InputProblem unknown = unknown_name("key", key, known_);
    unknown.file = value.origin.file;
    unknown.line = value.origin.line;
    unknown.key = full_key(key);
    unknown.value = value.text;
    throw InputError(unknown);
  }
}

void check_format(TableReader& reader, const std::string& kind, int newest_version) {
  const std::string wanted = fmt::format("{}/{}", kind, newest_version);
  const std::string given = reader.text("format");
  for (int version = 1; version <= newest_version; ++version) {
    if (given == fmt::format("{}/{}", kind, version)) return;
  }
  const bool same_kind = given.rfind(kind + "/", 0) == 0;
  throw reader.problem("format",
                       same_kind ? fmt::format("format version '{}' is not known to this program", given)
                                 : fmt::format("this is not a {} file but '{}'", kind, given),
                       fmt::format("format = \"{}\"", wanted));
}

}  // namespace rollrig
