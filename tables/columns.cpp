#include "tables/columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/file_io.h"

namespace rollrig::tables {

InputError make_too_large(const std::string& path) {
  return InputError({"what the file holds is too large", path, 0, "", "",
                     fmt::format("at most {} MiB of values, unpacked", kLargestTable_bytes >> 20), ""});
}

void require_table_size(std::uintmax_t bytes, const std::string& path) {
  if (bytes > kLargestTable_bytes) throw make_too_large(path);
}

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
