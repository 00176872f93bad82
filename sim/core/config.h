#pragma once
/// A TOML file as a tree that remembers where each value stands.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rollrig {

/// Where a value was written; line 0 for a value given on the command line.
struct Origin {
  std::string file;
  int line = 0;
};

struct ConfigValue;

/// Keys in alphabetical order, so that two readings of one file agree.
struct ConfigTable {
  std::map<std::string, ConfigValue> entries;
  Origin origin;

  const ConfigValue* find(const std::string& key) const;
  std::vector<std::string> keys() const;
};

using ConfigArray = std::vector<ConfigValue>;

struct ConfigValue {
  std::variant<bool, double, std::string, ConfigArray, ConfigTable> data;
  Origin origin;
  std::string text;  // as written, for messages

  const ConfigTable* as_table() const { return std::get_if<ConfigTable>(&data); }
  const ConfigArray* as_array() const { return std::get_if<ConfigArray>(&data); }
};

/// Reads and parses a TOML file. Throws InputError (missing, directory, unreadable, empty, binary, syntax).
ConfigTable read_config(const std::string& path);

/// Parses TOML text; `name` stands for the file in messages.
ConfigTable parse_config(std::string_view text, const std::string& name);

/// Sets a dotted key ("tire.thermal.H_gas_W_per_K") to a value written as in TOML; what is not TOML is taken
/// as a string. Tables on the way are made where absent.
void set_config_value(ConfigTable& root, const std::string& dotted_key, const std::string& value,
                      const std::string& origin_name);

}  // namespace rollrig
