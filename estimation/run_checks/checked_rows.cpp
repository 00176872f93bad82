#include "estimation/run_checks/checked_rows.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace rollrig::estimation {

CheckedRows::CheckedRows(const std::string& path) : table_(CsvTable::read(path, {}, &problems_)) {
  for (const InputProblem& problem : problems_) ragged_lines_.insert(problem.line);
  lines_out_ = ragged_lines_;
}

std::vector<double> CheckedRows::numbers(const Field& column) {
  const std::size_t known = problems_.size();
  std::vector<double> values = table_.numbers(column, false, &problems_);
  for (std::size_t i = known; i < problems_.size(); ++i) lines_out_.insert(problems_[i].line);
  return values;
}

std::vector<double> CheckedRows::spare_numbers(const Field& column) { return table_.numbers(column, true, &problems_); }

void CheckedRows::leave_out(const InputError& error) {
  problems_.push_back(error.problem());
  lines_out_.insert(error.problem().line);
}

void CheckedRows::leave_empty(const InputError& error) { problems_.push_back(error.problem()); }

std::vector<CheckedRows::Disorder> CheckedRows::find_disorder(const std::vector<std::size_t>& rows,
                                                              const std::vector<double>& values) const {
  std::vector<std::size_t> usable;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(usable), [this](std::size_t row) { return !is_out(row); });
  std::vector<double> sequence;
  for (const std::size_t row : usable) sequence.push_back(values[row]);
  const std::vector<bool> increases = find_increasing(sequence);
  std::vector<Disorder> disorder;
  for (std::size_t k = 0; k < usable.size(); ++k) {
    if (increases[k]) continue;
    std::size_t before = k, after = k;
    while (before > 0 && !increases[before]) --before;
    while (after + 1 < usable.size() && !increases[after]) ++after;
    const bool is_below = increases[before] && sequence[k] <= sequence[before];
    disorder.push_back({usable[k], usable[is_below ? before : after], is_below});
  }
  return disorder;
}

void CheckedRows::check_times(const std::string& column, const std::vector<std::size_t>& rows,
                              const std::vector<double>& times, const std::string& where) {
  for (const Disorder& found : find_disorder(rows, times)) {
    const std::string other = fmt::format("{:.10g}", times[found.other]);
    leave_out(table_.cell_error(found.row, column,
                                fmt::format("time does not increase{}: {:.10g} {} {}", where, times[found.row],
                                            found.is_below ? "after" : "before", other),
                                fmt::format("{} than {}", found.is_below ? "more" : "less", other)));
  }
}

measurements::LeftOutRows CheckedRows::list_left_out() const {
  measurements::LeftOutRows out;
  out.problems = problems_;
  std::stable_sort(out.problems.begin(), out.problems.end(),
                   [](const InputProblem& a, const InputProblem& b) { return a.line < b.line; });
  out.file_rows = table_.row_count() + ragged_lines_.size();
  out.rows = lines_out_.size();
  for (const InputProblem& problem : out.problems) out.fields += lines_out_.count(problem.line) == 0 ? 1 : 0;
  return out;
}

measurements::LeftOutRows CheckedRows::settle(BadRows bad_rows) const {
  measurements::LeftOutRows out = list_left_out();
  if (out.problems.empty()) return out;
  if (bad_rows == BadRows::kRefuse) throw measurements::make_bad_rows_error({out}, "");
  measurements::require_few_bad_rows(out, table_.path(), "");
  return out;
}

}  // namespace rollrig::estimation
