#include "measurements/run_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "sim/core/csv.h"

namespace rollrig::measurements {
namespace {

constexpr double kMostFar = 0.05;                // Assumed: share of the rows of a file
constexpr double kLongestGap_s = 5.0;            // Assumed: inputs run linearly over so much, as in an import
constexpr double kLongestGap_intervals = 2.5;    // Assumed: of a slow file, one row may be missing
constexpr double kLongestRun_s = 3.0 * 86400.0;  // Assumed: five minutes in milliseconds are longer
constexpr std::size_t kMostRows = 1000000;       // Assumed: a day at ten rows a second, 864,000; a diagnosis takes 2 GB
constexpr const char* kHint = "rollrig import reads logs of other forms, names and units, and writes such files";

double take_middle(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

InputError too_long(const CsvTable& csv, std::size_t row, double time_s) {
  return InputError({"a run of more than three days", csv.path(), csv.line_of(row), "time_s",
                     fmt::format("{:.10g}", time_s), "seconds, not milliseconds; of a longer test, several runs", ""});
}

void require_not_too_many(const std::string& path, std::size_t rows) {
  if (rows <= kMostRows) return;
  throw InputError({fmt::format("{} rows", rows), path, 0, "", "",
                    fmt::format("at most {} rows in a run. A tire warms up over minutes, so that averages over 0.1 s "
                                "are enough: rollrig import computes them (interval_s)",
                                kMostRows),
                    ""});
}

/// Single times that lie days away from the others are bad rows; many of them are another unit.
void find_far_times(const CsvTable& csv, const std::vector<double>& times, RowProblems& problems) {
  std::set<int> known;  // lines whose time is bad as it is
  for (const InputProblem& problem : problems) known.insert(problem.line);
  std::vector<std::size_t> good;
  std::vector<double> good_times;
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (std::isnan(times[row]) || known.count(csv.line_of(row)) > 0) continue;
    good.push_back(row);
    good_times.push_back(times[row]);
  }
  if (good.empty() || good_times.back() - good_times.front() <= kLongestRun_s) return;
  const double middle = take_middle(good_times);
  std::vector<std::size_t> far;
  for (const std::size_t row : good) {
    if (std::abs(times[row] - middle) > kLongestRun_s) far.push_back(row);
  }
  const bool are_stray =
      !far.empty() && static_cast<double>(far.size()) <= kMostFar * static_cast<double>(times.size());
  if (!are_stray) throw too_long(csv, good.back(), good_times.back());
  for (const std::size_t row : far) {
    problems.push_back(csv.cell_error(row, "time_s", "a time more than three days away from those of the other rows",
                                      fmt::format("less than three days from {:.10g}", middle))
                           .problem());
  }
}

bool is_measured(const rigs::RunColumns& columns, const std::string& heading) {
  return std::any_of(columns.measured.begin(), columns.measured.end(),
                     [&heading](const rigs::Column& column) { return column.quantity.header() == heading; });
}

/// Lines of the rows that cannot stay.
std::set<int> find_lines_out(const rigs::RunColumns& columns, const RowProblems& problems) {
  std::set<int> lines;
  for (const InputProblem& problem : problems) {
    if (!is_measured(columns, problem.key)) lines.insert(problem.line);
  }
  return lines;
}

/// Rows that stay: their places among all rows of the file.
struct KeptRows {
  std::vector<std::size_t> rows;
  std::vector<bool> is_beside;  // a row that was left out
};

KeptRows find_kept(const RunFileRows& file, const std::set<int>& out) {
  KeptRows kept;
  const auto lies_between = [&out](int from, int to) {
    const auto at = out.upper_bound(from);
    return at != out.end() && *at < to;
  };
  for (std::size_t row = 0; row < file.lines.size(); ++row) {
    const int line = file.lines[row];
    if (out.count(line) > 0) continue;
    const bool after = lies_between(kept.rows.empty() ? 0 : file.lines[kept.rows.back()], line);
    if (after && !kept.rows.empty()) kept.is_beside.back() = true;
    kept.rows.push_back(row);
    kept.is_beside.push_back(after);
  }
  if (!kept.rows.empty() && out.upper_bound(file.lines[kept.rows.back()]) != out.end()) kept.is_beside.back() = true;
  return kept;
}

/// Refuses stretches without a row that are too long, also before the first row: the tire's state is that of the start.
void require_short_gaps(const MeasuredRun& run, const RunFileRows& file, const KeptRows& kept,
                        const std::set<int>& out) {
  std::vector<double> steps_s;
  for (std::size_t k = 1; k < kept.rows.size(); ++k) {
    steps_s.push_back(run.time_s[kept.rows[k]] - run.time_s[kept.rows[k - 1]]);
  }
  const double interval_s = take_middle(steps_s);
  const double limit_s = std::max(kLongestGap_s, kLongestGap_intervals * interval_s);
  const auto require = [&](double gap_s, int line) {
    if (gap_s <= limit_s) return;
    throw InputError(
        {fmt::format("without its bad rows, run '{}' has no row for {:.3g} s", run.id, gap_s), run.file, line, "time_s",
         "", fmt::format("at most {:.3g} s, over which inputs are taken as straight lines; else two runs", limit_s),
         ""});
  };
  const auto first = static_cast<double>(std::distance(out.begin(), out.lower_bound(file.lines[kept.rows.front()])));
  require(first * interval_s, file.lines[kept.rows.front()]);
  for (std::size_t k = 1; k < kept.rows.size(); ++k) {
    if (kept.is_beside[k - 1] && kept.is_beside[k]) require(steps_s[k - 1], file.lines[kept.rows[k]]);
  }
}

void keep(const std::vector<std::size_t>& rows, std::vector<double>& values) {
  for (std::size_t k = 0; k < rows.size(); ++k) values[k] = values[rows[k]];
  values.resize(rows.size());
}

void leave_out(const rigs::RunColumns& columns, const RunFileRows& file, MeasuredRun& run) {
  const std::set<int> out = find_lines_out(columns, file.problems);
  const KeptRows kept = find_kept(file, out);
  if (kept.rows.size() < 2) {
    throw InputError({"a run needs two rows at least", run.file, 2, "", "", "two or more rows that can be used", ""});
  }
  if (!out.empty()) require_short_gaps(run, file, kept, out);
  keep(kept.rows, run.time_s);
  for (auto& [quantity, values] : run.columns) {
    keep(kept.rows, values);
    if (!is_measured(columns, quantity.header())) continue;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (kept.is_beside[k]) values[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  run.left_out.problems = file.problems;
  run.left_out.file_rows = file.file_rows;
  run.left_out.rows = out.size();
  for (const InputProblem& problem : file.problems) run.left_out.fields += out.count(problem.line) == 0 ? 1 : 0;
}

}  // namespace

RunFileRows read_run_columns(const rigs::RunColumns& columns, MeasuredRun& run) {
  CsvForm form;
  form.hint = kHint;
  form.encoding_hint = "UTF-8 text; rollrig import reads logs in other encodings: encoding = \"windows-1252\"";
  RunFileRows file;
  const CsvTable csv = CsvTable::read(run.file, form, &file.problems);
  std::vector<std::string> known{"time_s"};
  for (const rigs::Column& column : columns.all()) known.push_back(column.quantity.header());
  csv.require_known(known);
  file.file_rows = csv.row_count() + count_rows(file.problems);
  require_not_too_many(run.file, file.file_rows);
  run.time_s = csv.increasing_times("time_s", &file.problems);
  if (file.file_rows < 2) {
    throw InputError({"a run needs two rows at least", run.file, 2, "", "", "two or more rows", ""});
  }
  find_far_times(csv, run.time_s, file.problems);
  for (std::size_t row = 0; row < csv.row_count(); ++row) file.lines.push_back(csv.line_of(row));
  const auto read = [&](const std::vector<rigs::Column>& some, bool may_lack_column, bool may_lack_sample) {
    for (const rigs::Column& column : some) {
      const std::string heading = column.quantity.header();
      if (may_lack_column && !csv.has(heading)) continue;
      run.columns[column.quantity] =
          csv.numbers({heading.c_str(), column.range, column.doc}, may_lack_sample, &file.problems);
    }
  };
  read(columns.given, false, false);
  read(columns.optional_given, true, false);
  read(columns.measured, true, true);
  std::stable_sort(file.problems.begin(), file.problems.end(),
                   [](const InputProblem& a, const InputProblem& b) { return a.line < b.line; });
  return file;
}

void settle_bad_rows(const rigs::RunColumns& columns, BadRows bad_rows, const std::vector<RunFileRows>& files,
                     std::vector<MeasuredRun>& runs) {
  const auto has_bad = [](const RunFileRows& file) { return !file.problems.empty(); };
  if (std::none_of(files.begin(), files.end(), has_bad)) return;
  if (bad_rows == BadRows::kRefuse) throw make_bad_rows_error({files.begin(), files.end()}, kHint);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!has_bad(files[i])) continue;
    require_few_bad_rows(files[i], fmt::format("run '{}'", runs[i].id), kHint);
    leave_out(columns, files[i], runs[i]);
  }
}

std::vector<std::string> describe_bad_rows(const MeasurementSet& set) {
  std::vector<std::string> sentences;
  for (const MeasuredRun& run : set.runs) {
    if (run.left_out.problems.empty()) continue;
    sentences.push_back(describe_left_out(run.left_out, " of run " + run.id, run.file, "measured field"));
  }
  return sentences;
}

Json make_bad_rows_json(const MeasurementSet& set) {
  Json list = Json::array();
  for (const MeasuredRun& run : set.runs) {
    if (run.left_out.problems.empty()) continue;
    Json of_run{{"run", run.id}};
    of_run.update(make_left_out_json(run.left_out, run.file));
    list.push_back(of_run);
  }
  return list;
}

}  // namespace rollrig::measurements
