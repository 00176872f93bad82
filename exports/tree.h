#pragma once
/// What is exported, whatever the file: named things in groups. Units stand in the names and are told beside them by
/// the files (unit_of_key).

#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/core/config.h"
#include "sim/core/json.h"

namespace rollrig::exports {

struct Node;

/// Numbers of one name, such as a channel; NaN where there is none.
using Column = std::vector<double>;
/// Texts of one name, such as the phase of every row.
using Texts = std::vector<std::string>;

/// Named things in order.
struct Group {
  std::vector<std::pair<std::string, Node>> members;
  bool is_table = false;  // members are Columns and Texts of one length: rows of a recording, phases

  void add(const std::string& name, Node node);
};

/// Things without names that make no table.
struct List {
  std::vector<Node> items;
};

struct Node {
  std::variant<double, bool, std::string, Column, Texts, Group, List> value;
};

/// A JSON value with its keys in order: null is NaN, an array of numbers a Column, one of texts Texts, one of objects
/// with the same keys and no further depth a table, any other a List.
Node make_node(const Json& json);

/// A TOML table likewise.
Node make_node(const ConfigTable& table);

/// For names that a file's format allows: `name`, or where it is taken the first free of name_2, name_3, ...; taken
/// now.
std::string take_name(const std::string& name, std::set<std::string>& taken);

}  // namespace rollrig::exports
