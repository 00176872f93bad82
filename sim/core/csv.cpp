#include "sim/core/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

/// Splits RFC 4180 text into records; `line` is where a record starts.
class CsvScanner {
 public:
  CsvScanner(const std::string& text, const std::string& path, char separator)
      : text_(text), path_(path), ends_{separator, '\n'} {
    constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";  // as spreadsheets write it
    if (text_.rfind(kByteOrderMark, 0) == 0) position_ = 3;
  }

  bool at_end() const { return position_ >= text_.size(); }
  int line() const { return line_; }

  /// Passes over whole lines, whatever they hold, up to `line`.
  void go_to_line(int line) {
    for (; line_ < line && !at_end(); ++line_) position_ = std::min(text_.find('\n', position_), text_.size()) + 1;
  }

  std::vector<std::string> next_record() {
    std::vector<std::string> cells;
    bool more = true;
    while (more) cells.push_back(next_cell(more));
    return cells;
  }

 private:
  std::string next_cell(bool& more) {
    const bool quoted = !at_end() && text_[position_] == '"';
    std::string cell = quoted ? quoted_content() : std::string();
    const std::size_t end = std::min(text_.find_first_of(ends_, position_), text_.size());
    cell.append(text_, position_, end - position_);
    more = end < text_.size() && text_[end] != '\n';
    if (!more) {
      if (!cell.empty() && cell.back() == '\r') cell.pop_back();
      ++line_;
    }
    position_ = end + 1;
    return cell;
  }

  std::string quoted_content() {
    const int start_line = line_;
    std::string content;
    for (++position_; !at_end(); ++position_) {
      const char c = text_[position_];
      if (c == '\n') ++line_;
      if (c != '"') {
        content += c;
      } else if (position_ + 1 < text_.size() && text_[position_ + 1] == '"') {
        content += '"';
        ++position_;
      } else {
        ++position_;
        return content;
      }
    }
    throw InputError({"a quoted field never ends", path_, start_line, "", "", "a closing \"", ""});
  }

  const std::string& text_;
  const std::string& path_;
  const std::string ends_;  // of a cell
  std::size_t position_ = 0;
  int line_ = 1;
};

/// What is allowed, and what to do instead.
std::string allow(const std::string& allowed, const CsvForm& form) {
  return form.hint.empty() ? allowed : allowed + "; " + form.hint;
}

/// Asked where something is wrong with a line: whether it is a remark, of which there can be none. A lone # is the name
/// of a counter.
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

}  // namespace

CsvTable CsvTable::read(const std::string& path, const CsvForm& form) {
  const std::string text = read_text_file(path);
  CsvTable table;
  table.path_ = path;
  table.form_ = form;
  CsvScanner scanner(text, path, form.separator);
  scanner.go_to_line(form.header_line);
  table.columns_ = scanner.next_record();
  require_separated(table.columns_, path, form);
  for (std::size_t i = 0; i < table.columns_.size(); ++i) {
    const std::string& name = table.columns_[i];
    const auto end = table.columns_.begin() + static_cast<std::ptrdiff_t>(i);
    if (name.empty())
      throw InputError(
          {"a column has no name", path, form.header_line, "", "", "a header line with a name a column", ""});
    if (std::find(table.columns_.begin(), end, name) != end) {
      throw InputError(
          {fmt::format("column '{}' stands twice", name), path, form.header_line, name, "", "each column once", ""});
    }
  }
  scanner.go_to_line(form.first_row_line);
  while (!scanner.at_end()) {
    Row row;
    row.line = scanner.line();
    row.cells = scanner.next_record();
    if (row.cells.size() == 1 && row.cells[0].empty()) continue;  // a blank line, as at the end of a file
    if (row.cells.size() != table.columns_.size()) {
      require_no_comment(table.columns_.front(), path, form.header_line, form);
      require_no_comment(row.cells.front(), path, row.line, form);
      throw InputError({"ragged row", path, row.line, "", fmt::format("{} fields", row.cells.size()),
                        fmt::format("{} fields, as in the header", table.columns_.size()), ""});
    }
    table.rows_.push_back(std::move(row));
  }
  if (table.rows_.empty())
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
  cells.reserve(rows_.size());
  for (const Row& row : rows_) cells.push_back(row.cells[index]);
  return cells;
}

InputError CsvTable::cell_error(std::size_t row, const std::string& column, const std::string& what,
                                const std::string& allowed) const {
  const std::string& cell = rows_[row].cells[find_column(column)];
  return InputError({what, path_, line_of(row), column, cell.empty() ? "(empty)" : cell, allowed, ""});
}

double CsvTable::parse_cell(std::size_t row, const Field& field, const std::string& cell) const {
  const auto make_error = [&](const std::string& what, bool with_point = false) {
    const std::string range = field.range.to_string();
    const std::string allowed = range.empty() ? "a number" : "a number " + range;
    return cell_error(row, field.key, what, with_point ? allow(allowed + " with a decimal point", form_) : allowed);
  };
  double value = 0.0;
  std::string plain = cell;
  if (form_.decimal != '.') {
    std::replace(plain.begin(), plain.end(), '.', '?');  // a point is no number's then
    std::replace(plain.begin(), plain.end(), form_.decimal, '.');
  }
  const char* end = plain.data() + plain.size();
  const auto [stop, error] = std::from_chars(plain.data(), end, value);
  if (error != std::errc() || stop != end) {
    const bool has_comma = form_.decimal == '.' && parse_number(boost::algorithm::replace_all_copy(cell, ",", "."));
    throw make_error(fmt::format("'{}' is not a number", cell), has_comma);
  }
  if (!std::isfinite(value)) throw make_error(fmt::format("'{}' is not finite", cell));
  if (!field.range.contains(value)) throw make_error(fmt::format("{} is out of range", field.key));
  return value;
}

std::vector<double> CsvTable::numbers(const Field& column, bool may_be_empty) const {
  const std::size_t index = find_column(column.key);
  const Unit unit = unit_of_key(column.key);
  std::vector<double> values;
  values.reserve(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::string& cell = rows_[row].cells[index];
    if (!cell.empty()) {
      values.push_back(unit.to_si(parse_cell(row, column, cell)));
    } else if (may_be_empty) {
      values.push_back(std::numeric_limits<double>::quiet_NaN());
    } else {
      throw cell_error(row, column.key, fmt::format("'{}' has an empty field", column.key),
                       "a number in every row: this column is an input");
    }
  }
  return values;
}

std::vector<double> CsvTable::plain_numbers(const std::string& column, const std::vector<std::string>& missing) const {
  const std::size_t index = find_column(column);
  const Field field{column.c_str(), any_number(), ""};
  std::vector<double> values;
  values.reserve(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::string cell = boost::algorithm::trim_copy(rows_[row].cells[index]);
    const bool is_missing = cell.empty() || std::find(missing.begin(), missing.end(), cell) != missing.end();
    values.push_back(is_missing ? std::numeric_limits<double>::quiet_NaN() : parse_cell(row, field, cell));
  }
  return values;
}

std::vector<double> CsvTable::increasing_times(const std::string& column) const {
  const std::vector<double> times = numbers({column.c_str(), any_number(), "time"});
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    throw cell_error(i, column, fmt::format("time does not increase: {} after {}", times[i], times[i - 1]),
                     fmt::format("more than {}", times[i - 1]));
  }
  return times;
}

CsvWriter::CsvWriter(const std::vector<std::string>& columns) {
  for (const std::string& column : columns) add(column);
  end_row();
}

void CsvWriter::add(const Rounded& number) {
  const double written = number.value == 0.0 ? 0.0 : number.value;  // no "-0"
  if (!std::isnan(written)) fmt::format_to(std::back_inserter(text_), "{:.{}g}", written, number.digits);
  text_ += ',';
}

void CsvWriter::add(const std::string& text) {
  const bool is_plain = text.find_first_of(",\"\r\n") == std::string::npos;
  text_ += is_plain ? text : '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
  text_ += ',';
}

}  // namespace rollrig
