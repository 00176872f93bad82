#pragma once
/// What is exported: named things in groups, the same for every kind of file; where they are read from; and the files
/// that are made of them. Units stand in the names, and the files tell them beside the names (unit_of_key).

#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "include/rollrig/bad_rows.h"
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

/// The tree of a result folder (of `rollrig run --out`), of a measurement set, or of a recording.csv alone; numbers are
/// those of the files, in the files' units. A folder that is both is taken as a result, its set.toml as the set.
/// `warnings` gets what was left out of a set.
/// Members   format, source ("result", "measurements" or "recording"), and
///           of a result: recording, result, manifest (text);
///           of a set: set, tire, rig or vehicle, runs (a group a run, with its keys and a recording); bad_rows where
///           rows were left out;
///           of a recording: recording
/// Errors    InputError when it is none of these, or when a file of it is missing or wrong
/// Checked   tests/exports/source_test.cpp
Group read_source(const std::string& path, BadRows bad_rows = BadRows::kRefuse,
                  std::vector<std::string>* warnings = nullptr);

/// The bytes of an HDF5 file (readable since library 1.8). A Group is a group, its members in order; a Column a data
/// set of doubles, long ones deflated; Texts a data set of strings in UTF-8; a flag h5py's enumeration of FALSE and
/// TRUE; a List a group whose members are named by their place, from 0. Every number whose name says a unit has the
/// attribute `unit`. '/' in a name becomes '_'. The same tree gives the same bytes.
/// Checked  tests/exports/hdf5_file_test.cpp
std::string make_hdf5(const Group& tree);

/// The bytes of a .mat file (version 5): a member of `tree` is a variable. A Group is a struct, a table one with the
/// struct `units` (the unit of every member whose name says one) as its last field; a Column and Texts are columns
/// (double, cell), a flag is logical, a List a cell. Names are made MATLAB's: letters, digits and '_', a letter first,
/// 63 at most. The same tree gives the same bytes.
/// Errors   InputError where a variable is larger than the format holds (2 GB)
/// Checked  tests/exports/mat_file_test.cpp
std::string make_mat(const Group& tree);

}  // namespace rollrig::exports
