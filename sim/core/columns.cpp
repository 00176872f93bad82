#include "sim/core/columns.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "sim/core/text.h"
#include "sim/core/visible.h"

namespace rollrig {
namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kLongestNumber = 24;  // with a unit or an interval; what is longer is text

struct TextColumn {
  std::size_t width = 0;
  std::size_t least = 0;  // to which it can be narrowed
  bool is_number = true;
};

/// Bytes of the first `width` characters of a word, or fewer where its last part ends within them.
std::size_t find_break(const std::string& word, std::size_t width) {
  std::size_t bytes = 0;
  for (std::size_t characters = 0; bytes < word.size(); ++bytes) {
    if ((static_cast<unsigned char>(word[bytes]) & 0xC0U) != 0x80U && ++characters > width) break;
  }
  const std::size_t part = word.find_last_of("_/+,.:=-", bytes - 1);
  return part == std::string::npos || bytes == word.size() ? bytes : part + 1;
}

std::vector<std::string> wrap_cell(const std::string& cell, std::size_t width) {
  if (count_characters(cell) <= width) return {cell};
  std::vector<std::string> lines{""};
  std::istringstream words(cell);
  for (std::string word; words >> word; lines.back() += word) {
    if (!lines.back().empty() && count_characters(lines.back() + word) < width) {
      lines.back() += ' ';
    } else if (!lines.back().empty()) {
      lines.emplace_back();
    }
    for (; count_characters(word) > width; lines.emplace_back()) {
      const std::size_t bytes = find_break(word, width);
      lines.back() += word.substr(0, bytes);
      word.erase(0, bytes);
    }
  }
  return lines;
}

/// Characters of the longest word. A word of more than twelve may be broken.
std::size_t find_least(const std::string& cell) {
  std::size_t least = 0;
  std::istringstream words(cell);
  for (std::string word; words >> word;) least = std::max(least, count_characters(word));
  return std::min<std::size_t>(least, 12);
}

std::vector<TextColumn> measure_columns(const std::vector<std::vector<std::string>>& rows, bool has_header) {
  std::vector<TextColumn> columns(rows.front().size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    TextColumn& column = columns[i];
    std::size_t body = 0;
    for (std::size_t row = has_header ? 1 : 0; row < rows.size(); ++row) {
      const std::string& cell = rows[row][i];
      const bool begins_as_one = cell.empty() || cell.find_first_of("+-.0123456789") == 0;
      column.is_number &= has_header && begins_as_one && count_characters(cell) <= kLongestNumber;
      body = std::max(body, count_characters(cell));
    }
    for (const auto& row : rows) {
      column.width = std::max(column.width, count_characters(row[i]));
      column.least = std::max(column.least, find_least(row[i]));
    }
    if (column.is_number) column.least = std::max(body, find_least(rows.front()[i]));
  }
  return columns;
}

/// How many columns fit at their least.
std::size_t count_fitting(const std::vector<TextColumn>& columns, std::size_t width) {
  std::size_t used = 0;
  const auto is_beyond = [&](const TextColumn& each) { return (used += each.least + kGap) > width + kGap; };
  return static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(), is_beyond) - columns.begin());
}

/// Narrows the widest columns until all fit, or are at their least.
void narrow(std::vector<TextColumn>& columns, std::size_t width) {
  const auto excess = [](const TextColumn& each) { return each.width > each.least ? each.width : 0; };
  std::size_t used = 0;
  for (const TextColumn& each : columns) used += each.width + kGap;
  for (; used > width + kGap; --used) {
    const auto widest = std::max_element(columns.begin(), columns.end(), [&](const TextColumn& a, const TextColumn& b) {
      return excess(a) < excess(b);
    });
    if (excess(*widest) == 0) return;
    --widest->width;
  }
}

/// A row of cells as lines; a header stands at the bottom of its lines.
std::string format_row(const std::vector<std::string>& cells, const std::vector<TextColumn>& columns, bool is_header,
                       std::size_t indent) {
  std::vector<std::vector<std::string>> wrapped;
  std::size_t height = 1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    wrapped.push_back(wrap_cell(cells[i], columns[i].width));
    height = std::max(height, wrapped.back().size());
  }
  std::string text;
  for (std::size_t at = 0; at < height; ++at) {
    std::string line(indent, ' ');
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::size_t first = is_header ? height - wrapped[i].size() : 0;
      const std::string part = at >= first && at - first < wrapped[i].size() ? wrapped[i][at - first] : "";
      const std::string space(columns[i].width - std::min(columns[i].width, count_characters(part)), ' ');
      line += (i > 0 ? "  " : "") + (columns[i].is_number ? space + part : part + space);
    }
    text += line.erase(line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace

std::size_t terminal_columns(int descriptor) {
  winsize size{};
  const bool is_known = isatty(descriptor) != 0 && ioctl(descriptor, TIOCGWINSZ, &size) == 0;
  return std::max<std::size_t>(80, is_known ? size.ws_col : 0);
}

std::string text_columns(const std::vector<std::vector<std::string>>& given, const ColumnStyle& style) {
  if (given.empty()) return "";
  std::vector<std::vector<std::string>> rows = given;
  for (auto& row : rows) std::transform(row.begin(), row.end(), row.begin(), &show_on_one_line);
  std::vector<TextColumn> columns = measure_columns(rows, style.has_header);
  const std::size_t fitting = count_fitting(columns, style.width - style.indent);
  if (fitting > 1 && fitting < columns.size()) {
    std::vector<std::vector<std::string>> left = rows, right = rows;
    for (auto& row : left) row.erase(row.begin() + static_cast<std::ptrdiff_t>(fitting), row.end());
    for (auto& row : right) row.erase(row.begin() + 1, row.begin() + static_cast<std::ptrdiff_t>(fitting));
    return text_columns(left, style) + text_columns(right, style);
  }
  narrow(columns, style.width - style.indent);
  std::string text;
  for (const auto& row : rows)
    text += format_row(row, columns, style.has_header && &row == &rows.front(), style.indent);
  return text;
}

std::string format_table(const Table& table, std::size_t indent) {
  std::vector<std::vector<std::string>> rows = table.rows;
  const bool has_header = !table.columns.empty();
  if (has_header) rows.insert(rows.begin(), table.columns);
  for (auto& row : rows) row.resize(row.size() - table.page_only);
  return (table.title.empty() ? "" : wrap(table.title, indent)) + text_columns(rows, {has_header, indent});
}

std::string format_tables(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) text += format_table(table);
  return text;
}

std::string format_warnings(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += wrap("warning: " + warning, 2);
  return text;
}

}  // namespace rollrig
