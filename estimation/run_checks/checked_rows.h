#pragma once
/// Rows of CSV files of coastdowns, some of which cannot be used.

#include <set>
#include <string>
#include <vector>

#include "include/rollrig/bad_rows.h"
#include "measurements/left_out_rows.h"
#include "sim/core/csv.h"

namespace rollrig::estimation {

/// A file whose bad rows are noted, not thrown. Rows of a coastdown stand for themselves: what is left out changes
/// nothing for the others.
class CheckedRows {
 public:
  /// Throws InputError for what is wrong with the file as a whole.
  explicit CheckedRows(const std::string& path);

  const CsvTable& table() const { return table_; }
  std::size_t row_count() const { return table_.row_count(); }
  /// Whether a row cannot be used.
  bool is_out(std::size_t row) const { return lines_out_.count(table_.line_of(row)) > 0; }
  /// Whether the file has rows of another number of fields, which are no rows of the table.
  bool has_ragged() const { return !ragged_lines_.empty(); }

  /// As CsvTable::numbers(), with NaN and a bad row for a wrong cell.
  std::vector<double> numbers(const Field& column);
  /// The same of a column that the fit does not need: a wrong cell counts as an empty one, and its row stays.
  std::vector<double> spare_numbers(const Field& column);

  void leave_out(const InputError& error);
  void leave_empty(const InputError& error);

  /// Values that must increase from one of `rows` to the next of those that are not out: which of them are outside the
  /// longest sequence that does, each with the row of `rows` before it or after it that contradicts it.
  struct Disorder {
    std::size_t row = 0;
    std::size_t other = 0;
    bool is_below = true;  // not above the one before; else not below the one after
  };
  std::vector<Disorder> find_disorder(const std::vector<std::size_t>& rows, const std::vector<double>& values) const;
  /// Notes times that do not increase; `where` is empty, or " within run '1'".
  void check_times(const std::string& column, const std::vector<std::size_t>& rows, const std::vector<double>& times,
                   const std::string& where);

  /// What is bad, by line.
  measurements::LeftOutRows list_left_out() const;
  /// The same, where bad rows may be left out. Throws InputError where not, or if they are too many.
  measurements::LeftOutRows settle(BadRows bad_rows) const;

 private:
  RowProblems problems_;  // before the table, which fills it
  CsvTable table_;
  std::set<int> ragged_lines_;
  std::set<int> lines_out_;
};

}  // namespace rollrig::estimation
