#include "measurements/logs/resample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

namespace rollrig::measurements {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kGap = 1.5;      // intervals: between them a row is missing
constexpr double kWhole = 0.98;   // Assumed: covered but for the jitter of stamps
constexpr double kSlower = 1.02;  // a log is slower than the rows

/// Where a column of the set comes from.
struct Source {
  const Log* log = nullptr;
  double constant_SI = kNone;
};

Source find_source(const Mapping& mapping, const RunSources& sources, const Quantity& column) {
  const auto find_constant = [&column](const LogForm& form) {
    for (const LogColumn& mapped : form.columns) {
      if (mapped.target == column && mapped.constant_SI.has_value()) return *mapped.constant_SI;
    }
    return kNone;
  };
  if (sources.torque_log->has(column)) return {sources.torque_log, kNone};
  const double constant = find_constant(mapping.torque_log);
  if (!std::isnan(constant)) return {nullptr, constant};
  if (sources.tire_log == nullptr) return {};
  if (sources.tire_log->has(column)) return {sources.tire_log, kNone};
  if (!mapping.tire_log.has_value()) return {};  // a log that no mapping describes has columns but no constants
  return {nullptr, find_constant(*mapping.tire_log)};
}

double read_given(const Log& log, const Quantity& column, double time_s) {
  const std::vector<double>& values = log.columns.at(column);
  const double slack_s = std::max(1e-6, 1e-4 * log.interval_s);
  const auto after = std::upper_bound(log.time_s.begin(), log.time_s.end(), time_s + slack_s);
  if (after == log.time_s.begin()) return kNone;
  const auto i = static_cast<std::size_t>(after - log.time_s.begin()) - 1;
  if (std::abs(time_s - log.time_s[i]) <= slack_s) return values[i];
  if (i + 1 >= values.size()) return kNone;
  const double between_s = log.time_s[i + 1] - log.time_s[i];
  if (between_s > kGap * log.interval_s) return kNone;
  if (column == models::quantities::kLoad) return std::isnan(values[i + 1]) ? kNone : values[i];
  return values[i] + (values[i + 1] - values[i]) * (time_s - log.time_s[i]) / between_s;
}

/// Why a log has no value of a column at times that increase from question to question: what its first mark says that
/// meets the time asked for. Each mark is looked at a few times, whatever the number of questions.
class Reasons {
 public:
  /// Keeps a reference to `log`.
  Reasons(const Log& log, const Quantity& column) : log_(log), half_s_(0.5 * log.interval_s) {
    for (std::size_t i = 0; i < log.marks.size(); ++i) {
      const Quantity& of = log.marks[i].column;
      if (of.name().empty() || of == column) later_.push_back(i);
    }
    const auto begins_later = [&log](std::size_t a, std::size_t b) {
      return log.marks[a].from_s > log.marks[b].from_s;
    };
    std::stable_sort(later_.begin(), later_.end(), begins_later);
  }

  std::string find(double from_s, double to_s) {
    for (; !later_.empty() && log_.marks[later_.back()].from_s - half_s_ < to_s; later_.pop_back()) {
      begun_.insert(later_.back());
    }
    while (!begun_.empty() && !(log_.marks[*begun_.begin()].to_s + half_s_ > from_s)) begun_.erase(begun_.begin());
    return begun_.empty() ? "outside the log" : log_.marks[*begun_.begin()].reason;
  }

 private:
  const Log& log_;
  double half_s_;
  std::vector<std::size_t> later_;  // marks that begin after all times asked for, the next one last
  std::set<std::size_t> begun_;     // those that began, in the order of the log; the first one may have ended
};

/// What one sample of a log stands for.
struct Cell {
  double from_s = 0.0;
  double to_s = 0.0;
};

Cell find_cell(const Log& log, std::size_t i) {
  const double half_s = 0.5 * log.interval_s;
  Cell cell{log.time_s[i] - half_s, log.time_s[i] + half_s};
  const auto joined = [&log](std::size_t k) { return log.time_s[k + 1] - log.time_s[k] <= kGap * log.interval_s; };
  if (i > 0 && joined(i - 1)) cell.from_s = 0.5 * (log.time_s[i - 1] + log.time_s[i]);
  if (i + 1 < log.time_s.size() && joined(i)) cell.to_s = 0.5 * (log.time_s[i] + log.time_s[i + 1]);
  return cell;
}

/// Interval of each row: half-way to its neighbors.
std::vector<Cell> find_row_cells(const std::vector<double>& times) {
  std::vector<Cell> cells(times.size());
  for (std::size_t row = 0; row < times.size(); ++row) {
    cells[row].from_s = row == 0 ? times[row] : 0.5 * (times[row - 1] + times[row]);
    cells[row].to_s = row + 1 == times.size() ? times[row] : 0.5 * (times[row] + times[row + 1]);
  }
  return cells;
}

std::vector<double> calc_means(const Log& log, const Quantity& column, const std::vector<Cell>& rows) {
  const std::vector<double>& values = log.columns.at(column);
  std::vector<double> means(rows.size(), kNone);
  std::size_t first = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Cell& wanted = rows[row];
    while (first < values.size() && find_cell(log, first).to_s <= wanted.from_s) ++first;
    double sum = 0.0;
    double covered_s = 0.0;
    for (std::size_t i = first; i < values.size(); ++i) {
      const Cell cell = find_cell(log, i);
      if (cell.from_s >= wanted.to_s) break;
      if (std::isnan(values[i])) continue;
      const double share_s = std::min(cell.to_s, wanted.to_s) - std::max(cell.from_s, wanted.from_s);
      sum += values[i] * share_s;
      covered_s += share_s;
    }
    if (covered_s > 0.0 && covered_s >= kWhole * (wanted.to_s - wanted.from_s)) means[row] = sum / covered_s;
  }
  // A sample at an end of the run is a mean that reaches beyond it.
  const double interval_s = rows.size() > 2 ? rows[1].to_s - rows[1].from_s : 0.0;
  if (log.interval_s > 0.5 * interval_s) means.front() = means.back() = kNone;
  return means;
}

std::vector<double> place_samples(const Log& log, const Quantity& column, const std::vector<Cell>& rows) {
  const std::vector<double>& values = log.columns.at(column);
  std::vector<double> placed(rows.size(), kNone);
  std::size_t row = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (row < rows.size() && rows[row].to_s < log.time_s[i]) ++row;
    if (row == rows.size()) break;
    if (log.time_s[i] >= rows[row].from_s) placed[row] = values[i];
  }
  return placed;
}

void add_empty(ResampledRun& run, const EmptyRange& row, double interval_s) {
  if (!run.empty.empty()) {
    EmptyRange& last = run.empty.back();
    const bool goes_on = last.column == row.column && last.reason == row.reason &&
                         last.rows_left_out == row.rows_left_out && row.from_s - last.to_s < 1.5 * interval_s;
    if (goes_on) {
      last.to_s = row.to_s;
      ++last.rows;
      return;
    }
  }
  run.empty.push_back(row);
}

/// The rows of a run: their times on the torque log's clock, and what of the time each stands for.
struct RowGrid {
  std::vector<double> times;
  std::vector<Cell> cells;
  double interval_s = 0.0;
};

void add_measured(const Log& log, const Quantity& column, const RowGrid& rows, ResampledRun& run) {
  const auto& [times, cells, interval_s] = rows;
  const bool is_slow = log.interval_s > kSlower * interval_s;
  std::vector<double> values = is_slow ? place_samples(log, column, cells) : calc_means(log, column, cells);
  Reasons reasons(log, column);
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (!std::isnan(values[row])) continue;
    const bool is_end = row == 0 || row + 1 == times.size();
    // Between the samples of a slow log a row is empty for no reason but that.
    const double reach_s = is_slow ? 1e-9 : 0.0;
    std::string reason = reasons.find(cells[row].from_s + reach_s, cells[row].to_s - reach_s);
    const bool inside = times[row] >= log.time_s.front() && times[row] <= log.time_s.back();
    if (reason == "outside the log" && inside && is_slow) {
      ++run.rows_between[column];
      continue;
    }
    if (reason == "outside the log" && is_end) reason = "end of the run";
    add_empty(run, {column, times[row] - run.start_s, times[row] - run.start_s, 1, false, reason}, interval_s);
  }
  run.samples_a_row[column] = interval_s / log.interval_s;
  run.columns[column] = std::move(values);
}

InputError missing_input(const Log& log, const Quantity& column, double from_s, double to_s, double limit_s) {
  const auto at = std::lower_bound(log.time_s.begin(), log.time_s.end(), from_s - 1e-6);
  const auto row = std::min(static_cast<std::size_t>(at - log.time_s.begin()), log.time_s.size() - 1);
  return InputError(
      {fmt::format("'{}' is missing for {:.3g} s of the run, {}", column.header(), to_s - from_s,
                   Reasons(log, column).find(from_s, to_s)),
       log.file, log.line[row], column.header(), "",
       fmt::format("at most {:.3g} s (longest_given_gap_s); else from and to of [[run]], so that it ends before or "
                   "begins after",
                   limit_s),
       ""});
}

/// Given columns on a grid; rows that lack one are left out.
std::vector<double> add_given(const Mapping& mapping, const RunSources& sources, const std::vector<double>& grid,
                              double interval_s, ResampledRun& run) {
  std::vector<std::pair<Quantity, Source>> given;
  for (const rigs::Column& column : mapping.set.kind->columns.all_given()) {
    const Source source = find_source(mapping, sources, column.quantity);
    if (source.log != nullptr || !std::isnan(source.constant_SI)) given.emplace_back(column.quantity, source);
  }
  std::map<Quantity, Reasons> reasons;
  for (const auto& [column, source] : given) {
    if (source.log != nullptr) reasons.emplace(column, Reasons(*source.log, column));
  }
  std::vector<double> kept;
  for (const double time_s : grid) {
    std::vector<double> values;
    for (const auto& [column, source] : given) {
      values.push_back(source.log == nullptr ? source.constant_SI : read_given(*source.log, column, time_s));
      if (!std::isnan(values.back())) continue;
      const double since_s = kept.empty() ? grid.front() : kept.back();
      if (time_s - since_s > mapping.longest_given_gap_s) {
        const auto is_back = [&, &source = source, &column = column](double later_s) {
          return later_s > time_s && !std::isnan(read_given(*source.log, column, later_s));
        };
        const auto back = std::find_if(grid.begin(), grid.end(), is_back);
        throw missing_input(*source.log, column, since_s + (kept.empty() ? 0.0 : interval_s),
                            back == grid.end() ? grid.back() : *back, mapping.longest_given_gap_s);
      }
      const std::string reason = reasons.at(column).find(time_s - 1e-6, time_s + 1e-6);
      add_empty(run, {column, time_s - run.start_s, time_s - run.start_s, 1, true, reason}, interval_s);
      break;
    }
    if (std::isnan(values.back())) continue;
    kept.push_back(time_s);
    for (std::size_t k = 0; k < given.size(); ++k) run.columns[given[k].first].push_back(values[k]);
  }
  return kept;
}

}  // namespace

ResampledRun resample_run(const Mapping& mapping, const RunSources& sources, double interval_s, double from_s,
                          double to_s) {
  ResampledRun run;
  run.start_s = from_s;
  constexpr double kMostRows = 1e7;  // Assumed: a day at 100 Hz is less
  const auto require_rows = [&](bool holds) {
    if (holds) return;
    throw InputError(
        {fmt::format("a run from {:.6g} to {:.6g} s of the log in rows of {:.6g} s has fewer than three rows "
                     "or more than ten million",
                     from_s - sources.torque_log->time_s.front(), to_s - sources.torque_log->time_s.front(),
                     interval_s),
         sources.torque_log->file, 0, "from, to, interval_s", "", "from before to, three rows or more", ""});
  };
  require_rows(to_s - from_s >= 0.0 && (to_s - from_s) / interval_s < kMostRows);
  std::vector<double> grid;
  const auto count = static_cast<std::size_t>(std::floor((to_s - from_s) / interval_s + 1e-3)) + 1;
  for (std::size_t k = 0; k < count; ++k) grid.push_back(from_s + static_cast<double>(k) * interval_s);
  const std::vector<double> times = add_given(mapping, sources, grid, interval_s, run);
  require_rows(times.size() >= 3);
  for (const double time_s : times) run.time_s.push_back(time_s - from_s);
  const RowGrid rows{times, find_row_cells(times), interval_s};
  for (const Quantity& column : measured_channels(*mapping.set.kind)) {
    const Source source = find_source(mapping, sources, column);
    if (source.log != nullptr) add_measured(*source.log, column, rows, run);
  }
  return run;
}

}  // namespace rollrig::measurements
