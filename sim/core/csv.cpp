#include "sim/core/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "sim/core/csv_scanner.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

/// What is allowed, and what to do instead.
std::string allow(const std::string& allowed, const CsvForm& form) {
  return form.hint.empty() ? allowed : allowed + "; " + form.hint;
}

/// Called for a line that is wrong. Throws InputError if the line is a comment, of which a CSV file has none. A lone #
/// may be the name of a column that counts.
void require_no_comment(const std::string& first, const std::string& path, int line, const CsvForm& form) {
  if (first.size() < 2 || (first.front() != '#' && first.front() != '%')) return;
  throw InputError({"a comment, of which this file can have none", path, line, "", first.substr(0, 60),
                    allow(fmt::format("a header in line {} and rows below it", form.header_line), form), ""});
}

/// Refuses a header that only looks like one column because its fields are separated by something else.
void require_separated(const std::vector<std::string>& header, const std::string& path, const CsvForm& form) {
  if (header.size() != 1) return;
  for (const char other : {';', '\t', ','}) {
    if (other == form.separator || header[0].find(other) == std::string::npos) continue;
    const std::string name = other == ';' ? "semicolons" : other == '\t' ? "tabs" : "commas";
    throw InputError({"the fields are separated by " + name, path, form.header_line, "", header[0].substr(0, 60),
                      allow(form.separator == ',' ? "commas between fields and a point in numbers, as formats.md has it"
                                                  : "the separator that is named",
                            form),
                      ""});
  }
}

/// Throws InputError for a file that would be one line.
void require_line_feeds(const std::string& text, const std::string& path) {
  if (text.find('\r') == std::string::npos || text.find('\n') != std::string::npos) return;
  throw InputError({"the lines of this file end with a carriage return (CR) alone", path, 1, "", "",
                    "lines that end with LF, or with CR and LF: save the file again as CSV with such lines", ""});
}

}  // namespace

void CsvTable::read_header(const std::vector<std::string>& names) {
  require_separated(names, path_, form_);
  if (names.size() > kMostColumns) {
    throw InputError({"too many columns", path_, form_.header_line, "", format_count(names.size(), "column"),
                      fmt::format("at most {}", kMostColumns), ""});
  }
  std::unordered_set<std::string> known;
  for (const std::string& name : names) {
    if (name.empty()) {
      throw InputError(
          {"a column has no name", path_, form_.header_line, "", "", "a header line with a name a column", ""});
    }
    if (!known.insert(name).second) {
      throw InputError(
          {fmt::format("column '{}' stands twice", name), path_, form_.header_line, name, "", "each column once", ""});
    }
  }
  columns_ = names;
}

void CsvTable::add_row(int line, const std::vector<std::string>& cells) {
  if (cells.size() == 1 && cells[0].empty()) return;  // a blank line, as at the end of a file
  if (cells.size() != columns_.size()) {
    require_no_comment(columns_.front(), path_, form_.header_line, form_);
    require_no_comment(cells.front(), path_, line, form_);
    throw InputError({"ragged row", path_, line, "", format_count(cells.size(), "field"),
                      fmt::format("{} fields, as in the header", columns_.size()), ""});
  }
  store_row(line, cells);
}

void CsvTable::store_row(int line, const std::vector<std::string>& cells) {
  for (const std::string& text : cells) {
    if (text.size() > std::numeric_limits<std::uint32_t>::max() - cells_.size()) {
      throw InputError({"too much text in a table", path_, line, "", "", "less than 4 GiB in all cells together", ""});
    }
    cells_ += text;
    cell_ends_.push_back(static_cast<std::uint32_t>(cells_.size()));
  }
  lines_.push_back(line);
}

std::string_view CsvTable::cell(std::size_t row, std::size_t column) const {
  const std::size_t index = row * columns_.size() + column;
  const std::size_t begin = index == 0 ? 0 : cell_ends_[index - 1];
  return std::string_view(cells_).substr(begin, cell_ends_[index] - begin);
}

CsvTable CsvTable::read(const std::string& path, const CsvForm& form, RowProblems* problems) {
  const std::string text = read_text_file(path, form.encoding, form.encoding_hint);
  require_line_feeds(text, path);
  CsvTable table;
  table.path_ = path;
  table.form_ = form;
  CsvScanner scanner(text, path, form.separator);
  scanner.go_to_line(form.header_line);
  if (scanner.at_end()) {
    throw InputError({"the file ends before its header", path, scanner.line(), "",
                      fmt::format("header in line {}", form.header_line), allow("a header, and rows below it", form),
                      ""});
  }
  table.read_header(scanner.next_record());
  table.cells_.reserve(text.size());
  scanner.go_to_line(form.first_row_line);
  while (!scanner.at_end()) {
    throw_if_interrupted();
    const int line = scanner.line();
    try {
      table.add_row(line, problems != nullptr ? scanner.next_line() : scanner.next_record());
    } catch (const InputError& error) {
      if (problems == nullptr) throw;
      problems->push_back(error.problem());
    }
  }
  if (table.lines_.empty() && (problems == nullptr || problems->empty()))
    throw InputError({"a header but no rows", path, form.header_line, "", "", "at least one row", ""});
  return table;
}

bool CsvTable::has(const std::string& column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

void CsvTable::require_known(const std::vector<std::string>& known) const {
  for (const std::string& column : columns_) {
    if (std::find(known.begin(), known.end(), column) != known.end()) continue;
    require_no_comment(column, path_, form_.header_line, form_);
    InputProblem problem = unknown_name("column", column, known);
    problem.file = path_;
    problem.line = form_.header_line;
    problem.key = column;
    problem.allowed = allow(problem.allowed, form_);
    if (boost::algorithm::trim_copy(column) != column) problem.what += ", with a blank before or after the name";
    throw InputError(problem);
  }
}

std::size_t CsvTable::find_column(const std::string& column) const {
  const auto it = std::find(columns_.begin(), columns_.end(), column);
  if (it != columns_.end()) return static_cast<std::size_t>(it - columns_.begin());
  throw InputError({fmt::format("missing column '{}'", column), path_, form_.header_line, column, "",
                    "it beside these: " + boost::algorithm::join(columns_, ", "), nearest_name(column, columns_)});
}

std::vector<std::string> CsvTable::text(const std::string& column) const {
  const std::size_t index = find_column(column);
  std::vector<std::string> cells;
  cells.reserve(row_count());
  for (std::size_t row = 0; row < row_count(); ++row) cells.emplace_back(cell(row, index));
  return cells;
}

InputError CsvTable::cell_error(std::size_t row, const std::string& column, const std::string& what,
                                const std::string& allowed) const {
  const std::string value(cell(row, find_column(column)));
  return InputError({what, path_, line_of(row), column, value.empty() ? "(empty)" : shorten(value, 60), allowed, ""});
}

double CsvTable::parse_cell(std::size_t row, const Field& field, std::string_view cell) const {
  const auto make_error = [&](const std::string& what, bool with_point = false) {
    const std::string range = field.range.to_string();
    const std::string allowed = range.empty() ? "a number" : "a number " + range;
    return cell_error(row, field.key, what, with_point ? allow(allowed + " with a decimal point", form_) : allowed);
  };
  double value = 0.0;
  std::string plain(cell);
  if (form_.decimal != '.') {
    std::replace(plain.begin(), plain.end(), '.', '?');  // a point is no number's then
    std::replace(plain.begin(), plain.end(), form_.decimal, '.');
  }
  const char* end = plain.data() + plain.size();
  const auto [stop, error] = std::from_chars(plain.data(), end, value);
  if (error != std::errc() || stop != end) {
    const bool has_comma =
        form_.decimal == '.' && parse_number(boost::algorithm::replace_all_copy(std::string(cell), ",", "."));
    throw make_error(fmt::format("'{}' is not a number", shorten(std::string(cell), 60)), has_comma);
  }
  if (!std::isfinite(value)) throw make_error(fmt::format("'{}' is not finite", shorten(std::string(cell), 60)));
  if (!field.range.contains(value)) throw make_error(fmt::format("{} is out of range", field.key));
  return value;
}

template <class Parse>
double CsvTable::parse_or_note(RowProblems* problems, const Parse& parse) {
  if (problems == nullptr) return parse();
  try {
    return parse();
  } catch (const InputError& error) {
    problems->push_back(error.problem());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

std::vector<double> CsvTable::numbers(const Field& column, bool may_be_empty, RowProblems* problems) const {
  const std::size_t index = find_column(column.key);
  const Unit unit = unit_of_key(column.key);
  std::vector<double> values;
  values.reserve(row_count());
  for (std::size_t row = 0; row < row_count(); ++row) {
    const std::string_view text = cell(row, index);
    values.push_back(parse_or_note(problems, [&] {
      if (!text.empty()) return unit.to_si(parse_cell(row, column, text));
      if (may_be_empty) return std::numeric_limits<double>::quiet_NaN();
      throw cell_error(row, column.key, fmt::format("'{}' has an empty field", column.key),
                       "a number in every row: this column is an input");
    }));
  }
  return values;
}

std::vector<double> CsvTable::plain_numbers(const std::string& column, const std::vector<std::string>& missing,
                                            RowProblems* problems) const {
  const std::size_t index = find_column(column);
  const Field field{column.c_str(), any_number(), ""};
  std::vector<double> values;
  values.reserve(row_count());
  for (std::size_t row = 0; row < row_count(); ++row) {
    const std::string text = boost::algorithm::trim_copy(std::string(cell(row, index)));
    const bool is_missing = text.empty() || std::find(missing.begin(), missing.end(), text) != missing.end();
    values.push_back(is_missing ? std::numeric_limits<double>::quiet_NaN()
                                : parse_or_note(problems, [&] { return parse_cell(row, field, text); }));
  }
  return values;
}

RowProblems CsvTable::find_wrong_times(const std::string& column, const std::vector<double>& times) const {
  const std::vector<bool> increases = find_increasing(times);
  std::vector<std::size_t> next(times.size() + 1, times.size());  // row that increases, this one or a later one
  for (std::size_t row = times.size(); row-- > 0;) next[row] = increases[row] ? row : next[row + 1];
  RowProblems problems;
  std::size_t before = times.size();
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (increases[row]) before = row;
    if (increases[row] || std::isnan(times[row])) continue;
    const bool falls = before < times.size() && times[row] <= times[before];
    const std::size_t index = find_column(column);
    const std::string other(cell(falls ? before : next[row], index));
    problems.push_back(
        cell_error(row, column,
                   fmt::format("time does not increase: {} {} {}", cell(row, index), falls ? "after" : "before", other),
                   fmt::format("{} than {}", falls ? "more" : "less", other))
            .problem());
  }
  return problems;
}

std::vector<double> CsvTable::increasing_times(const std::string& column, RowProblems* problems) const {
  std::vector<double> times = numbers({column.c_str(), any_number(), "time"}, false, problems);
  const RowProblems wrong = find_wrong_times(column, times);
  if (!wrong.empty() && problems == nullptr) throw InputError(wrong.front());
  if (problems != nullptr) problems->insert(problems->end(), wrong.begin(), wrong.end());
  return times;
}

}  // namespace rollrig
