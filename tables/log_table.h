#pragma once
/// A log as a table, whatever the format of its file.

#include <map>
#include <set>
#include <string>

#include "sim/core/csv.h"

namespace rollrig::tables {

struct LogTable {
  CsvTable rows;
  std::map<std::string, std::string> units = {};  // of a column, as the file says it, where it does
  std::set<std::string> not_read = {};            // columns of the file that are no numbers or texts
};

/// Reads a file by what it begins with: a .mat file, HDF5, MDF4, or CSV as `form` says. Of a file that holds several
/// tables, the columns that are as long as the column `key` are taken. Lines are numbered from 1, one a row, where a
/// file has none. With `problems`, wrong rows of a CSV file are added there and left out.
/// Errors   InputError: see CsvTable::read; a damaged file, a column `key` that is not there
/// Checked  tests/tables/log_table_test.cpp
LogTable read_log_table(const std::string& path, const CsvForm& form, const std::string& key,
                        RowProblems* problems = nullptr);

}  // namespace rollrig::tables
