#pragma once
/// Columns of a file that is no CSV: the files of MATLAB, HDF5, TYDEX and MDF.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "sim/core/error.h"

namespace rollrig::tables {

/// Numbers, or texts such as time stamps, one a row. A number that is not there is NaN. A column that the file has but
/// that is not read has no rows.
struct Column {
  std::string name;   // with the groups that it is in: "run1.speed" of a .mat file, "run1/speed" of an HDF5 file
  std::string group;  // the part of the name before the last separator, with it; empty at the top
  std::variant<std::vector<double>, std::vector<std::string>> values;
  int recording = 0;      // columns with the same rows, where the format says so; 0 where it does not
  std::string unit = {};  // as the file says it; empty where it says none

  std::size_t size() const {
    return std::visit([](const auto& rows) { return rows.size(); }, values);
  }
};

using Columns = std::vector<Column>;

/// For values that take more than a table may have, kLargestTable_bytes.
InputError make_too_large(const std::string& path);
/// Throws that where so many bytes of values do.
void require_table_size(std::uintmax_t bytes, const std::string& path);

/// The columns of a matrix whose longer side is its rows: "name.1", "name.2", ...; a vector is one column `name`.
/// `values` are column by column. None of a single number.
void add_matrix(const std::string& name, const std::string& group, std::size_t rows, std::size_t columns,
                const std::vector<double>& values, Columns& out);

}  // namespace rollrig::tables
