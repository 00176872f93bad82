#include "sim/core/csv.h"

namespace rollrig {

CsvTable CsvTable::of_columns(const std::string& path, const std::vector<std::string>& names,
                              std::vector<std::vector<std::string>> cells) {
  CsvTable table;
  table.path_ = path;
  table.columns_ = names;
  const std::size_t row_count = cells.empty() ? 0 : cells.front().size();
  std::vector<std::string> row(cells.size());
  for (std::size_t i = 0; i < row_count; ++i) {
    for (std::size_t k = 0; k < cells.size(); ++k) row[k] = std::move(cells[k][i]);
    table.store_row(static_cast<int>(i) + 1, row);
  }
  return table;
}

}  // namespace rollrig
