#include "sim/core/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "sim/core/columns.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

constexpr std::size_t kMostShown = 20;     // rows of a file
constexpr std::size_t kLongestValue = 20;  // characters of it that a table shows

std::string without_hint(const std::string& allowed, const std::string& hint) {
  const std::string end = "; " + hint;
  const bool has_it = !hint.empty() && allowed.size() > end.size() &&
                      allowed.compare(allowed.size() - end.size(), end.size(), end) == 0;
  return has_it ? allowed.substr(0, allowed.size() - end.size()) : allowed;
}

/// Median time from row to row of a sequence; rows that it passes over count.
double calc_step(const std::vector<double>& times, const std::vector<std::size_t>& rows) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    steps.push_back((times[rows[k]] - times[rows[k - 1]]) / static_cast<double>(rows[k] - rows[k - 1]));
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Where of two neighboring rows either could belong to the sequence, that one belongs to it whose time is nearer to
/// what even steps give. Two rows tell no step: then it is the earlier one.
void prefer_even_steps(const std::vector<double>& times, std::vector<std::size_t>& rows) {
  if (rows.size() < 2) return;
  const double step = calc_step(times, rows);
  const bool has_step = rows.size() > 2;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool is_first = k == 0, is_last = k + 1 == rows.size();
    const auto miss_from = [&](std::size_t early, std::size_t late) {
      return std::abs(times[late] - times[early] - static_cast<double>(late - early) * step);
    };
    const auto miss = [&](std::size_t row) {
      return (is_first ? 0.0 : miss_from(rows[k - 1], row)) + (is_last ? 0.0 : miss_from(row, rows[k + 1]));
    };
    const auto can_replace = [&](std::size_t row) {
      if (row >= times.size() || std::isnan(times[row])) return false;
      const bool is_after = is_first || (row > rows[k - 1] && times[row] > times[rows[k - 1]]);
      return is_after && (is_last || (row < rows[k + 1] && times[row] < times[rows[k + 1]]));
    };
    for (const std::size_t other : {rows[k] - 1, rows[k] + 1}) {  // before the first row, this is none
      if (!can_replace(other)) continue;
      if (has_step ? miss(other) < miss(rows[k]) : other < rows[k]) rows[k] = other;
    }
  }
}

/// The problems of one file, by line.
std::string format_file(const RowProblems& problems, const std::string& hint) {
  constexpr std::size_t kWidth = 80;
  std::vector<std::vector<std::string>> cells{{"line", "column", "value", "allowed"}};
  std::set<int> lines;
  for (const InputProblem& problem : problems) {
    if (lines.size() == kMostShown && lines.count(problem.line) == 0) break;
    lines.insert(problem.line);
    cells.push_back({std::to_string(problem.line), problem.key.empty() ? "(row)" : problem.key,
                     shorten(problem.value, kLongestValue), without_hint(problem.allowed, hint)});
  }
  const std::size_t count = count_rows(problems);
  std::string text = fmt::format("  {}: {}\n", problems.front().file, format_count(count, "bad row"));
  text += text_columns(cells, {true, 4, kWidth});
  if (count > lines.size()) text += fmt::format("    and {} more\n", format_count(count - lines.size(), "row"));
  return text;
}

}  // namespace

std::size_t count_rows(const RowProblems& problems) {
  std::set<std::pair<std::string, int>> rows;
  for (const InputProblem& problem : problems) rows.emplace(problem.file, problem.line);
  return rows.size();
}

std::vector<bool> find_increasing(const std::vector<double>& times) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> ends;  // row of the lowest end of a sequence of so many rows
  std::vector<std::size_t> before(times.size(), kNone);
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (std::isnan(times[row])) continue;
    const auto at = std::lower_bound(ends.begin(), ends.end(), times[row],
                                     [&times](std::size_t end, double time) { return times[end] < time; });
    if (at != ends.end() && times[*at] == times[row]) continue;
    if (at != ends.begin()) before[row] = *(at - 1);
    if (at == ends.end()) {
      ends.push_back(row);
    } else {
      *at = row;
    }
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = ends.empty() ? kNone : ends.back(); row != kNone; row = before[row]) rows.push_back(row);
  std::reverse(rows.begin(), rows.end());
  prefer_even_steps(times, rows);
  std::vector<bool> belongs(times.size(), false);
  for (const std::size_t row : rows) belongs[row] = true;
  return belongs;
}

std::string format_row_problems(const RowProblems& problems, const std::string& hint) {
  std::vector<std::string> files;  // in the order in which they were read
  std::map<std::string, RowProblems> of_file;
  for (const InputProblem& problem : problems) {
    if (of_file.count(problem.file) == 0) files.push_back(problem.file);
    of_file[problem.file].push_back(problem);
  }
  std::string text;
  for (const std::string& file : files) {
    RowProblems& some = of_file.at(file);
    std::stable_sort(some.begin(), some.end(),
                     [](const InputProblem& a, const InputProblem& b) { return a.line < b.line; });
    text += format_file(some, hint);
  }
  return text;
}

InputError make_rows_error(const std::string& what, const RowProblems& problems, const std::string& remedy,
                           const std::string& hint) {
  const auto join = [](const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + "; " + b;
  };
  if (problems.size() == 1) {
    InputProblem one = problems.front();
    one.allowed = join(one.allowed, remedy);
    return InputError(one);
  }
  std::string list = what + "\n" + format_row_problems(problems, hint);
  list.pop_back();
  return InputError({list, "", 0, "", "", join(remedy, hint), ""});
}

}  // namespace rollrig
