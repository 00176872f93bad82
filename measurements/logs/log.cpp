#include "measurements/logs/log.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/algorithm/string/trim.hpp>

#include "measurements/logs/file_units.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"

namespace rollrig::measurements {
namespace {

/// Stamps of one log, row after row; a time of day that falls back by more than half a day is of the next day.
class StampReader {
 public:
  explicit StampReader(const TimeColumn& time) : time_(time) {}

  /// Throws std::invalid_argument.
  double read(const std::string& text, const std::string& date) {
    if (time_.form == TimeForm::kIso8601) {
      const IsoStamp stamp = parse_iso_8601(text);
      with_offset_ = stamp.has_offset;
      return stamp.time_s - (stamp.has_offset ? 0.0 : offset_s());
    }
    if (time_.form == TimeForm::kDateTime) return parse_date_time_s(text, time_.date_order) - offset_s();
    double time_s = parse_date_days(date, time_.date_order) * kDay_s + parse_clock_s(text) - offset_s();
    if (time_.date_column.empty()) {
      time_s += day_ * kDay_s;
      if (time_s < last_s_ - 0.5 * kDay_s) {
        day_ += 1.0;
        time_s += kDay_s;
      }
      last_s_ = time_s;
    }
    return time_s;
  }
  bool is_utc() const { return with_offset_ || time_.utc_offset_s.has_value(); }

 private:
  double offset_s() const { return time_.utc_offset_s.value_or(0.0); }

  const TimeColumn& time_;
  double day_ = 0.0;
  double last_s_ = -std::numeric_limits<double>::infinity();
  bool with_offset_ = false;
};

/// A number of the time column as seconds.
double calc_time_s(const TimeColumn& time, double number) {
  if (time.form == TimeForm::kSeconds) return number * time.unit_s;
  const double since_1970_s =
      time.form == TimeForm::kEpochSeconds ? number * time.unit_s : from_spreadsheet_days(number);
  return since_1970_s - time.utc_offset_s.value_or(0.0);
}

std::vector<double> read_numeric_times(const LogForm& form, const CsvTable& csv, RowProblems& problems) {
  std::vector<double> times = csv.plain_numbers(form.time.column, {}, &problems);
  for (double& time : times) time = calc_time_s(form.time, time);
  const std::vector<std::string> cells = csv.text(form.time.column);
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (!boost::algorithm::trim_copy(cells[row]).empty()) continue;
    problems.push_back(
        csv.cell_error(row, form.time.column, "a row has no time", example_of(form.time.form)).problem());
  }
  return times;
}

std::vector<double> read_written_times(const LogForm& form, const CsvTable& csv, Log& log, RowProblems& problems) {
  const std::vector<std::string> stamps = csv.text(form.time.column);
  const bool has_dates = !form.time.date_column.empty();
  const std::vector<std::string> dates = has_dates ? csv.text(form.time.date_column) : std::vector<std::string>();
  StampReader reader(form.time);
  std::vector<double> times;
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    try {
      const std::string date = boost::algorithm::trim_copy(has_dates ? dates[row] : form.time.date);
      times.push_back(reader.read(boost::algorithm::trim_copy(stamps[row]), date));
    } catch (const std::invalid_argument& error) {
      times.push_back(std::numeric_limits<double>::quiet_NaN());
      problems.push_back(csv.cell_error(row, form.time.column,
                                        fmt::format("a time stamp is not understood: {}", error.what()),
                                        example_of(form.time.form))
                             .problem());
    }
  }
  log.is_utc = reader.is_utc();
  return times;
}

/// The rows with a time that can be used; their places among all rows of the file.
std::vector<std::size_t> read_times(const LogForm& form, const CsvTable& csv, Log& log, RowProblems& problems) {
  log.is_absolute = form.time.form != TimeForm::kSeconds;
  log.is_utc = log.is_absolute && (form.time.utc_offset_s.has_value() || form.time.form == TimeForm::kEpochSeconds);
  std::vector<double> times = is_number(form.time.form) ? read_numeric_times(form, csv, problems)
                                                        : read_written_times(form, csv, log, problems);
  std::set<int> wrong;
  for (const InputProblem& problem : csv.find_wrong_times(form.time.column, times)) {
    wrong.insert(problem.line);
    problems.push_back(problem);
  }
  std::vector<std::size_t> kept;
  std::vector<double> steps;
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (std::isnan(times[row]) || wrong.count(csv.line_of(row)) > 0) continue;
    if (!kept.empty()) steps.push_back(times[row] - log.time_s.back());
    kept.push_back(row);
    log.time_s.push_back(times[row]);
    log.line.push_back(csv.line_of(row));
  }
  if (kept.size() < 3) {
    if (!problems.empty()) {
      throw make_rows_error(format_count(count_rows(problems), "bad row"), problems, "", form.csv.hint);
    }
    throw InputError({"a log needs three rows at least", csv.path(), 1, "", "", "three or more rows", ""});
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  log.interval_s = *middle;
  return kept;
}

/// What is out of range is marked; more than a few such values are a wrong unit or column.
void check_range(const LogColumn& column, const Log& log, const std::vector<std::size_t>& outside,
                 const std::vector<double>& values, std::size_t count) {
  constexpr double kMostOutside = 0.01;  // Assumed
  if (static_cast<double>(outside.size()) <= std::max(1.0, kMostOutside * static_cast<double>(count))) return;
  const std::string symbol = column.target.file_unit().symbol;
  throw InputError(
      {fmt::format("{} of {} values of '{}' are out of range", outside.size(), count, column.target.header()), log.file,
       log.line[outside.front()], column.column, fmt::format("{:.6g} {}", values[outside.front()], symbol),
       fmt::format("{} {}; is the unit right?", column.allowed.to_string(), symbol), ""});
}

/// A column at the rows that are kept; NaN, and a problem, where a field is wrong.
std::vector<double> read_values(const LogColumn& column, const LogForm& form, const CsvTable& csv,
                                const std::vector<std::size_t>& kept, RowProblems& problems) {
  const std::vector<double> all = csv.plain_numbers(column.column, form.missing, &problems);
  std::vector<double> values;
  values.reserve(kept.size());
  for (const std::size_t row : kept) values.push_back(all[row]);
  return values;
}

void read_column(const LogColumn& column, const LogForm& form, const CsvTable& csv,
                 const std::vector<std::size_t>& kept, Log& log, RowProblems& problems) {
  const Unit target = column.target.file_unit();
  RowProblems of_column;
  std::vector<double> values = read_values(column, form, csv, kept, of_column);
  std::set<int> bad;
  for (const InputProblem& problem : of_column) bad.insert(problem.line);
  problems.insert(problems.end(), of_column.begin(), of_column.end());
  std::vector<std::size_t> outside;
  std::size_t count = 0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    double& value = values[row];
    const bool is_there = !std::isnan(value);
    if (is_there) {
      ++count;
      value = target.from_si(column.unit.to_si(value * column.factor + column.offset));
      if (value != 0.0 && std::abs(value) <= column.dead_band) {
        value = 0.0;
        ++log.dead_banded[column.target];
      }
      if (column.allowed.contains(value)) continue;
      outside.push_back(row);
    }
    const int line = log.line[row];
    const char* reason = is_there ? "out of range" : bad.count(line) > 0 ? "bad field" : "no value";
    log.marks.push_back({log.file, line, column.target, log.time_s[row], log.time_s[row],
                         is_there ? std::optional<double>(value) : std::nullopt, reason});
  }
  check_range(column, log, outside, values, count);
  for (const std::size_t row : outside) values[row] = std::numeric_limits<double>::quiet_NaN();
  for (double& value : values) value = target.to_si(value);
  log.columns[column.target] = std::move(values);
}

/// Rows of the file that are none of the log: their time is not known, so that of the row before stands for it.
void mark_bad_rows(const RowProblems& problems, Log& log) {
  for (const InputProblem& problem : problems) {
    const auto after = std::upper_bound(log.line.begin(), log.line.end(), problem.line) - log.line.begin();
    const double time_s = log.time_s[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0))];
    log.marks.push_back({log.file, problem.line, {}, time_s, time_s, std::nullopt, "bad row"});
  }
}

void mark_gaps(Log& log) {
  constexpr double kGap = 1.5;  // intervals: a row is missing
  for (std::size_t row = 1; row < log.time_s.size(); ++row) {
    if (log.time_s[row] - log.time_s[row - 1] <= kGap * log.interval_s) continue;
    log.marks.push_back(
        {log.file, log.line[row - 1], {}, log.time_s[row - 1], log.time_s[row], std::nullopt, "no rows"});
  }
}

}  // namespace

Log read_log(const LogForm& form, const std::string& path, RowProblems* problems,
             const std::function<void(double)>& report) {
  // Assumed: shares of the time, as measured with logs of 100 MB.
  constexpr double kSplit = 0.25, kTimesRead = 0.75;
  const auto report_share = [&report](double share) {
    throw_if_interrupted();
    if (report) report(share);
  };
  RowProblems found;
  const tables::LogTable table = tables::read_log_table(path, form.csv, form.time.column, &found);
  require_units(form, table);
  const CsvTable& csv = table.rows;
  report_share(kSplit);
  Log log;
  log.file = path;
  log.form = form.name;
  const std::vector<std::size_t> kept = read_times(form, csv, log, found);
  mark_bad_rows(found, log);
  for (std::size_t i = 0; i < form.columns.size(); ++i) {
    report_share(kTimesRead + (1.0 - kTimesRead) * static_cast<double>(i) / static_cast<double>(form.columns.size()));
    if (!form.columns[i].constant_SI.has_value()) read_column(form.columns[i], form, csv, kept, log, found);
  }
  if (!found.empty() && problems == nullptr) {
    throw make_rows_error(format_count(count_rows(found), "bad row"), found, "", form.csv.hint);
  }
  if (problems != nullptr) problems->insert(problems->end(), found.begin(), found.end());
  for (const std::string& name : csv.columns()) {
    const bool used = name == form.time.column || name == form.time.date_column ||
                      std::any_of(form.columns.begin(), form.columns.end(),
                                  [&name](const LogColumn& column) { return column.column == name; });
    if (!used) log.ignored_columns.push_back(name);
  }
  mark_gaps(log);
  return log;
}

double parse_log_time(const LogForm& form, const Log& log, const std::string& text, const std::string& key,
                      const Origin& origin) {
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    return InputError({what, origin.file, origin.line, "[[run]] " + key, text, allowed, ""});
  };
  double time_s = 0.0;
  if (is_number(form.time.form)) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), time_s);
    if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(time_s)) {
      throw refuse(fmt::format("'{}' is not a time of the torque log", text), example_of(form.time.form));
    }
    time_s = calc_time_s(form.time, time_s);
  } else {
    try {
      const bool has_date = !form.time.date.empty();
      const std::size_t blank = text.find(' ');
      const bool dated = form.time.form == TimeForm::kClock && !has_date && blank != std::string::npos;
      const std::string date = dated ? text.substr(0, blank) : form.time.date;
      time_s = StampReader(form.time).read(dated ? text.substr(blank + 1) : text, date);
      while (has_date && time_s < log.time_s.front() - 0.5 * kDay_s) time_s += kDay_s;
    } catch (const std::invalid_argument& error) {
      throw refuse(fmt::format("'{}' is not a time of the torque log: {}", text, error.what()),
                   example_of(form.time.form));
    }
  }
  if (time_s < log.time_s.front() - 0.5 * log.interval_s || time_s > log.time_s.back() + 0.5 * log.interval_s) {
    throw refuse(
        fmt::format("'{}' lies outside the torque log {}", text, log.file),
        fmt::format("a time between its first row, line {}, and its last, line {}", log.line.front(), log.line.back()));
  }
  return time_s;
}

}  // namespace rollrig::measurements
