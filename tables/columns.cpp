#include "tables/columns.h"

#include <algorithm>

namespace rollrig::tables {

void add_matrix(const std::string& name, const std::string& group, std::size_t rows, std::size_t columns,
                const std::vector<double>& values, Columns& out) {
  if (rows * columns != values.size() || values.size() < 2) return;
  if (rows == 1 || columns == 1) {
    out.push_back({name, group, values});
    return;
  }
  const bool is_across = columns > rows;  // a channel is a row
  const std::size_t length = std::max(rows, columns);
  for (std::size_t channel = 0; channel < std::min(rows, columns); ++channel) {
    std::vector<double> column(length);
    for (std::size_t i = 0; i < length; ++i)
      column[i] = is_across ? values[channel + i * rows] : values[channel * rows + i];
    out.push_back({name + "." + std::to_string(channel + 1), group, std::move(column)});
  }
}

}  // namespace rollrig::tables
