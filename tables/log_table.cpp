#include "tables/log_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "tables/formats.h"
#include "tables/isolated.h"

namespace rollrig::tables {
namespace {

/// The first bytes of a file; fewer where it is shorter or cannot be read.
std::string read_start(const std::string& path, std::size_t count) {
  std::string start(count, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(count));
  start.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return start;
}

bool has_at(const std::string& text, std::size_t at, const std::string& part) {
  return text.size() >= at + part.size() && text.compare(at, part.size(), part) == 0;
}

/// None of a CSV file.
std::optional<Columns> read_columns(const std::string& path) {
  require_file(path);
  const std::string start = read_start(path, 1024);
  const std::string kHdf5 = "\x89HDF\r\n\x1a\n";
  if (has_at(start, 0, kHdf5) || has_at(start, 512, kHdf5))
    return read_isolated(path, read_hdf5);  // 512: after MATLAB's header
  if (has_at(start, 0, "MDF     ") || has_at(start, 0, "UnFinMF ")) return read_isolated(path, read_mdf4);
  if (has_at(start, 0, "MATLAB 5.0 MAT-file")) return read_isolated(path, read_mat);
  return std::nullopt;
}

std::vector<std::string> make_cells(const Column& column) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) return *texts;
  std::vector<std::string> cells;
  for (const double value : std::get<std::vector<double>>(column.values)) {
    cells.push_back(std::isnan(value) ? "" : fmt::format("{}", value));
  }
  return cells;
}

/// "a, b and 40 more"
std::string list_some(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  const std::size_t shown = std::min(kMost, names.size());
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

const Column& find_column(const Columns& columns, const std::string& path, const std::string& key) {
  std::vector<std::string> names;
  for (const Column& column : columns) {
    if (column.size() > 0 && column.name == key) return column;
    if (column.size() > 0) names.push_back(column.name);
  }
  throw InputError({fmt::format("missing column '{}'", key), path, 0, key, "", "one of " + list_some(names),
                    nearest_name(key, names)});
}

}  // namespace

LogTable read_log_table(const std::string& path, const CsvForm& form, const std::string& key, RowProblems* problems) {
  const std::optional<Columns> columns = read_columns(path);
  if (!columns.has_value()) return {CsvTable::read(path, form, problems), {}, {}};
  if (columns->empty()) {
    throw InputError(
        {"no columns of numbers", path, 0, "", "", "vectors of two values or more, also in structs and groups", ""});
  }
  const Column& of_key = find_column(*columns, path, key);
  LogTable table;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells;
  for (const Column& column : *columns) {
    if (column.size() == 0) table.not_read.insert(column.name);
    if (column.size() != of_key.size() || column.recording != of_key.recording) continue;
    names.push_back(column.name);
    cells.push_back(make_cells(column));
    if (!column.unit.empty()) table.units[column.name] = column.unit;
  }
  table.rows = CsvTable::of_columns(path, names, cells);
  return table;
}

}  // namespace rollrig::tables
