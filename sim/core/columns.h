#pragma once
/// Tables of plain text, as wide as the terminal.

#include <cstddef>
#include <string>
#include <vector>

namespace rollrig {

/// Width of a terminal, of standard output unless another descriptor is given: at least 80, and 80 where it is none.
std::size_t terminal_columns(int descriptor = 1);

/// How rows of cells become columns.
struct ColumnStyle {
  bool has_header = false;  // the first row is one; columns of numbers then stand to the right
  std::size_t indent = 2;
  std::size_t width = terminal_columns();
};

/// Rows of equally many cells as lines, with two spaces between columns. A cell that is too wide continues on the next
/// line of its column; nothing is cut. Columns for which there is no room follow below, beside the first column again.
/// Checked  tests/core/columns_test.cpp
std::string text_columns(const std::vector<std::vector<std::string>>& rows, const ColumnStyle& style = {});

/// What a terminal, a page or a document shows as a table. Without columns, each row is a label and its value.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::size_t page_only = 0;  // so many of the last columns are for a page: a terminal has no room for them
};

/// The table below its title, if it has one.
std::string format_table(const Table& table, std::size_t indent = 2);
std::string format_tables(const std::vector<Table>& tables);
std::string format_warnings(const std::vector<std::string>& warnings);

}  // namespace rollrig
