#include "measurements/logs/guess_form.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <boost/algorithm/string/trim.hpp>

#include "measurements/logs/guess_units.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig::measurements {
namespace {

struct TextLine {
  int number = 0;  // in the file
  std::string text;
  std::vector<std::string> cells{};
};

/// Lines that are not blank.
std::vector<TextLine> list_text_lines(const std::string& path) {
  std::string text = read_table_file(path);
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
  std::vector<TextLine> lines;
  std::size_t from = 0;
  for (int number = 1; from < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::string line = text.substr(from, end - from);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) lines.push_back({number, std::move(line)});
    from = end + 1;
  }
  return lines;
}

std::vector<std::string> split_cells(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == separator && !is_quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) boost::algorithm::trim(cell);
  return cells;
}

/// The number of cells of a row, where nearly all of the last lines have the same one; else 0.
std::size_t count_cells(const std::vector<TextLine>& lines, char separator) {
  constexpr std::size_t kTail = 200;
  constexpr double kNearlyAll = 0.95;
  std::map<std::size_t, std::size_t> counts;
  const std::size_t first = lines.size() > kTail ? lines.size() - kTail : lines.size() / 2;
  for (std::size_t i = first; i < lines.size(); ++i) ++counts[split_cells(lines[i].text, separator).size()];
  for (const auto& [cells, count] : counts) {
    const double share = static_cast<double>(count) / static_cast<double>(lines.size() - first);
    if (cells >= 2 && share >= kNearlyAll) return cells;
  }
  return 0;
}

/// A number, a date or a time.
bool is_datum(const std::string& cell) {
  return cell.find_first_of("0123456789") != std::string::npos &&
         cell.find_first_not_of("0123456789+-.,:/TZ eE") == std::string::npos;
}

std::size_t count_filled(const std::vector<std::string>& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const std::string& cell) { return !cell.empty(); }));
}

bool is_row(const std::vector<std::string>& cells) {
  const auto data = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), &is_datum));
  return data >= 2 && 2 * data >= count_filled(cells);
}

bool is_row_of_units(const std::vector<std::string>& cells) {
  const auto units = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), [](const std::string& cell) {
    return cell == "-" ||
           find_unit(boost::algorithm::trim_copy_if(cell, boost::algorithm::is_any_of("[]()"))).has_value();
  }));
  return units >= 1 && 2 * units >= count_filled(cells);
}

void find_separator(const std::string& path, std::vector<TextLine>& lines, GuessedForm& form, std::size_t& cells) {
  for (const char separator : {';', '\t', ','}) {
    cells = count_cells(lines, separator);
    if (cells == 0) continue;
    form.csv.separator = separator;
    for (TextLine& line : lines) line.cells = split_cells(line.text, separator);
    return;
  }
  throw InputError({"no separator gives rows of one length", path, lines.empty() ? 0 : lines.back().number, "",
                    lines.empty() ? "" : lines.back().text.substr(0, 60),
                    "a table whose columns are separated by semicolons, tabs or commas; or a mapping that says how it "
                    "is written (docs/import.md)",
                    ""});
}

/// Finds the headings, the units and the first row. Returns the index of the first row.
std::size_t find_heading(const std::string& path, const std::vector<TextLine>& lines, std::size_t cells,
                         GuessedForm& form) {
  std::size_t first_row = 0;
  std::vector<const TextLine*> above;  // lines of text that are as long as the rows
  for (; first_row < lines.size(); ++first_row) {
    const TextLine& line = lines[first_row];
    if (line.cells.size() != cells) continue;
    if (is_row(line.cells)) break;
    above.push_back(&line);
  }
  const bool has_units = above.size() >= 2 && is_row_of_units(above.back()->cells);
  if (above.empty() || first_row == lines.size()) {
    throw InputError({"there is no line with the names of the columns above the numbers", path,
                      first_row < lines.size() ? lines[first_row].number : 0, "", "",
                      fmt::format("a line of {} names", cells), ""});
  }
  if (has_units) {
    form.units = above.back()->cells;
    above.pop_back();
  }
  form.headings = above.back()->cells;
  form.csv.header_line = above.back()->number;
  form.csv.first_row_line = lines[first_row].number;
  return first_row;
}

void find_decimal(const std::string& path, const std::vector<TextLine>& lines, std::size_t first_row,
                  GuessedForm& form) {
  std::size_t points = 0, commas = 0;
  for (std::size_t i = first_row; i < lines.size(); ++i) {
    for (const std::string& cell : lines[i].cells) {
      if (cell.find('.') != std::string::npos && parse_log_number(cell, '.').has_value()) ++points;
      if (cell.find(',') != std::string::npos && parse_log_number(cell, ',').has_value()) ++commas;
    }
  }
  if (form.csv.separator == ',') commas = 0;
  if (points > 0 && commas > 0) {
    throw InputError({"some numbers have a decimal point and others a decimal comma", path, lines[first_row].number, "",
                      fmt::format("{} with a point, {} with a comma", points, commas),
                      "one decimal sign, and no sign between thousands", ""});
  }
  form.csv.decimal = commas > 0 ? ',' : '.';
  form.has_decimals = points + commas > 0;
}

/// Words in columns of numbers, as far as they are few.
void find_missing(const std::vector<TextLine>& lines, std::size_t first_row, GuessedForm& form) {
  constexpr double kFew = 0.1;  // Assumed: of the rows
  for (std::size_t column = 0; column < form.headings.size(); ++column) {
    std::map<std::string, std::size_t> words;
    std::size_t count = 0;
    for (std::size_t i = first_row; i < lines.size(); ++i) {
      if (column >= lines[i].cells.size() || lines[i].cells[column].empty()) continue;
      const std::string& cell = lines[i].cells[column];
      ++count;
      if (!is_datum(cell) && !parse_log_number(cell, form.csv.decimal).has_value()) ++words[cell];
    }
    for (const auto& [word, times] : words) {
      if (static_cast<double>(times) > kFew * static_cast<double>(count)) continue;
      if (std::find(form.missing.begin(), form.missing.end(), word) == form.missing.end()) form.missing.push_back(word);
    }
  }
}

}  // namespace

bool GuessedForm::operator==(const GuessedForm& other) const {
  return std::tie(csv.separator, csv.decimal, csv.header_line, csv.first_row_line, headings, units) ==
         std::tie(other.csv.separator, other.csv.decimal, other.csv.header_line, other.csv.first_row_line,
                  other.headings, other.units);
}

std::optional<double> parse_log_number(const std::string& cell, char decimal) {
  std::string plain = boost::algorithm::trim_copy(cell);
  if (decimal != '.') {
    std::replace(plain.begin(), plain.end(), '.', '?');  // a point is no number's then
    std::replace(plain.begin(), plain.end(), decimal, '.');
  }
  return parse_number(plain);
}

GuessedForm guess_form(const std::string& path) {
  std::vector<TextLine> lines = list_text_lines(path);
  GuessedForm form;
  std::size_t cells = 0;
  find_separator(path, lines, form, cells);
  const std::size_t first_row = find_heading(path, lines, cells, form);
  find_decimal(path, lines, first_row, form);
  find_missing(lines, first_row, form);
  return form;
}

CsvTable read_guessed_table(const std::string& path, const GuessedForm& form) {
  CsvForm csv = form.csv;
  csv.hint = "a mapping says how a log is written where that cannot be guessed (docs/import.md)";
  return CsvTable::read(path, csv);
}

}  // namespace rollrig::measurements
