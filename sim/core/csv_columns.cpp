#include "sim/core/csv.h"

namespace rollrig {

CsvTable CsvTable::of_columns(const std::string& path, const std::vector<std::string>& names,
                              std::vector<std::vector<std::string>> cells) {
  CsvTable table;
  table.path_ = path;
  table.columns_ = names;
  table.rows_.resize(cells.empty() ? 0 : cells.front().size());
  for (std::size_t row = 0; row < table.rows_.size(); ++row) {
    table.rows_[row].line = static_cast<int>(row) + 1;
    for (std::vector<std::string>& column : cells) table.rows_[row].cells.push_back(std::move(column[row]));
  }
  return table;
}

}  // namespace rollrig
