#pragma once
/// CSV (RFC 4180: one header line, fields may be quoted) with messages that name line and column.
///
/// Own code because no package at hand reads a file whose columns are known only at run time and tells
/// the line of a wrong field: fast-cpp-csv-parser fixes the number of columns when it is compiled.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/rows.h"
#include "sim/core/schema.h"

namespace rollrig {

/// How a logger or a spreadsheet wrote its file.
struct CsvForm {
  char separator = ',';
  char decimal = '.';
  int header_line = 1;             // lines before it are not read
  int first_row_line = 2;          // lines between header and this one (units, say) are not read
  std::string hint{};              // for errors: what to do where a file is of another form
  std::string encoding = "utf-8";  // one of encoding_names(); a byte order mark of UTF-16 decides by itself
  std::string encoding_hint{};     // for errors: where to say the encoding
};

constexpr std::size_t kMostColumns = 10000;  // Assumed: of one table; loggers have hundreds

/// A CSV file as text cells. With `problems`, what is wrong with single rows is added there and not thrown.
class CsvTable {
 public:
  /// Reads a file. Throws InputError: see read_text_file, and no header, a header without rows, more than kMostColumns
  /// columns, a column without a name or named twice, fields that are separated by something else, ragged rows, a quote
  /// that never ends. With `problems`, each row is one line, rows that are ragged or have a quote that does not end are
  /// left out, and the table may have no rows.
  static CsvTable read(const std::string& path, const CsvForm& form = {}, RowProblems* problems = nullptr);

  /// A table of cells that a file of another format holds, column by column; row i is "line" i + 1.
  static CsvTable of_columns(const std::string& path, const std::vector<std::string>& names,
                             std::vector<std::vector<std::string>> cells);

  const std::string& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const { return lines_.size(); }
  bool has(const std::string& column) const;
  /// Line of the file on which a row begins.
  int line_of(std::size_t row) const { return lines_[row]; }
  /// What is wrong with a cell, with its line and text, for the caller to throw.
  InputError cell_error(std::size_t row, const std::string& column, const std::string& what,
                        const std::string& allowed) const;
  /// Throws InputError, with the nearest known name, for a column that is not among `known`.
  void require_known(const std::vector<std::string>& known) const;

  /// The cells of a column as text. Throws InputError when the column is absent.
  std::vector<std::string> text(const std::string& column) const;
  /// A column in SI units by the unit in its name. An empty cell is an error, or NaN with `may_be_empty`. With
  /// `problems`, a wrong cell is NaN.
  std::vector<double> numbers(const Field& column, bool may_be_empty = false, RowProblems* problems = nullptr) const;
  /// A column as it is written, in no unit: NaN where the cell is empty or among `missing`, and with `problems` where
  /// it is wrong. Blanks around a number are passed over.
  std::vector<double> plain_numbers(const std::string& column, const std::vector<std::string>& missing,
                                    RowProblems* problems = nullptr) const;
  /// The time column: numbers that increase from row to row. A row is wrong if it is outside the longest sequence that
  /// increases. With `problems`, wrong rows keep their times.
  std::vector<double> increasing_times(const std::string& column, RowProblems* problems = nullptr) const;
  /// What is wrong with times of a column that do not increase. Empty if all do. NaN is passed over.
  RowProblems find_wrong_times(const std::string& column, const std::vector<double>& times) const;

 private:
  void read_header(const std::vector<std::string>& names);
  /// The row, if it is no blank line. Throws InputError.
  void add_row(int line, const std::vector<std::string>& cells);
  void store_row(int line, const std::vector<std::string>& cells);
  std::string_view cell(std::size_t row, std::size_t column) const;
  std::size_t find_column(const std::string& column) const;
  /// Returns what `parse` returns. With `problems`, an InputError is added to them, and NaN is returned.
  template <class Parse>
  static double parse_or_note(RowProblems* problems, const Parse& parse);
  double parse_cell(std::size_t row, const Field& field, std::string_view cell) const;

  std::string path_;
  CsvForm form_;
  std::vector<std::string> columns_;
  // All cells in one string, row by row: a string for each cell would take several times the memory.
  std::string cells_;
  std::vector<std::uint32_t> cell_ends_;  // of each cell in cells_
  std::vector<int> lines_;                // of each row
};

/// Builds CSV text. Numbers are written so that reading them back gives the same value to so many significant digits,
/// nine unless Rounded says otherwise.
class CsvWriter {
 public:
  explicit CsvWriter(const std::vector<std::string>& columns);

  struct Rounded {
    double value;
    int digits;
  };
  void add(const Rounded& number);  // NaN is written as an empty field
  void add(double value) { add(Rounded{value, 9}); }
  void add(const std::string& text);
  void end_row() { text_.back() = '\n'; }
  template <class... Cells>
  void add_row(const Cells&... cells) {
    (add(cells), ...);
    end_row();
  }
  /// What was added since the last call.
  std::string take() { return std::exchange(text_, std::string()); }

 private:
  std::string text_;
};

}  // namespace rollrig
