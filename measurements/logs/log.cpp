#include "measurements/logs/log.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/algorithm/string/trim.hpp>

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

std::vector<double> read_numeric_times(const LogForm& form, const CsvTable& csv) {
  std::vector<double> times = csv.plain_numbers(form.time.column, {});
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (std::isnan(times[row])) {
      throw InputError({"a row has no time", csv.path(), csv.line_of(row), form.time.column, "(empty)",
                        example_of(form.time.form), ""});
    }
    times[row] = form.time.form == TimeForm::kSeconds
                     ? times[row] * form.time.unit_s
                     : from_spreadsheet_days(times[row]) - form.time.utc_offset_s.value_or(0.0);
  }
  return times;
}

std::vector<double> read_written_times(const LogForm& form, const CsvTable& csv, Log& log) {
  const std::vector<std::string> stamps = csv.text(form.time.column);
  const bool has_dates = !form.time.date_column.empty();
  const std::vector<std::string> dates =
      has_dates ? csv.text(form.time.date_column) : std::vector<std::string>(stamps.size(), form.time.date);
  StampReader reader(form.time);
  std::vector<double> times;
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    const std::string stamp = boost::algorithm::trim_copy(stamps[row]);
    try {
      times.push_back(reader.read(stamp, boost::algorithm::trim_copy(dates[row])));
    } catch (const std::invalid_argument& error) {
      throw InputError({fmt::format("a time stamp is not understood: {}", error.what()), csv.path(), csv.line_of(row),
                        form.time.column, stamps[row], example_of(form.time.form), ""});
    }
  }
  log.is_utc = reader.is_utc();
  return times;
}

void read_times(const LogForm& form, const CsvTable& csv, Log& log) {
  const bool is_number = form.time.form == TimeForm::kSeconds || form.time.form == TimeForm::kSpreadsheetDays;
  log.is_absolute = form.time.form != TimeForm::kSeconds;
  log.is_utc = log.is_absolute && form.time.utc_offset_s.has_value();
  log.time_s = is_number ? read_numeric_times(form, csv) : read_written_times(form, csv, log);
  if (log.time_s.size() < 3) {
    throw InputError({"a log needs three rows at least", csv.path(), 1, "", "", "three or more rows", ""});
  }
  const std::vector<std::string> stamps = csv.text(form.time.column);
  std::vector<double> steps;
  for (std::size_t row = 0; row < log.time_s.size(); ++row) {
    log.line.push_back(csv.line_of(row));
    if (row == 0) continue;
    steps.push_back(log.time_s[row] - log.time_s[row - 1]);
    if (steps.back() > 0.0) continue;
    throw InputError({fmt::format("time does not increase: '{}' after '{}'", stamps[row], stamps[row - 1]), csv.path(),
                      csv.line_of(row), form.time.column, stamps[row], "a later time in each row", ""});
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  log.interval_s = *middle;
}

/// What is out of range is marked; more than a few such values are a wrong unit or column.
void check_range(const LogColumn& column, const CsvTable& csv, const std::vector<std::size_t>& outside,
                 const std::vector<double>& values, std::size_t count) {
  constexpr double kMostOutside = 0.01;  // Assumed
  if (static_cast<double>(outside.size()) <= std::max(1.0, kMostOutside * static_cast<double>(count))) return;
  const std::string symbol = column.target.file_unit().symbol;
  throw InputError(
      {fmt::format("{} of {} values of '{}' are out of range", outside.size(), count, column.target.header()),
       csv.path(), csv.line_of(outside.front()), column.column,
       fmt::format("{:.6g} {}", values[outside.front()], symbol),
       fmt::format("{} {}; is the unit right?", column.allowed.to_string(), symbol), ""});
}

void read_column(const LogColumn& column, const LogForm& form, const CsvTable& csv, Log& log) {
  const Unit target = column.target.file_unit();
  std::vector<double> values = csv.plain_numbers(column.column, form.missing);
  std::vector<std::size_t> outside;
  std::size_t count = 0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    double& value = values[row];
    Mark mark{csv.path(), csv.line_of(row), column.target, log.time_s[row], log.time_s[row], std::nullopt, "no value"};
    if (!std::isnan(value)) {
      ++count;
      value = target.from_si(column.unit.to_si(value * column.factor + column.offset));
      if (value != 0.0 && std::abs(value) <= column.dead_band) {
        value = 0.0;
        ++log.dead_banded[column.target];
      }
      if (column.allowed.contains(value)) continue;
      outside.push_back(row);
      mark.value = value;
      mark.reason = "out of range";
    }
    log.marks.push_back(mark);
  }
  check_range(column, csv, outside, values, count);
  for (const std::size_t row : outside) values[row] = std::numeric_limits<double>::quiet_NaN();
  for (double& value : values) value = target.to_si(value);
  log.columns[column.target] = std::move(values);
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

Log read_log(const LogForm& form, const std::string& path) {
  const CsvTable csv = CsvTable::read(path, form.csv);
  Log log;
  log.file = path;
  log.form = form.name;
  read_times(form, csv, log);
  for (const LogColumn& column : form.columns) {
    if (!column.constant_SI.has_value()) read_column(column, form, csv, log);
  }
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
  if (form.time.form == TimeForm::kSeconds || form.time.form == TimeForm::kSpreadsheetDays) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), time_s);
    if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(time_s)) {
      throw refuse(fmt::format("'{}' is not a time of the torque log", text), example_of(form.time.form));
    }
    time_s = form.time.form == TimeForm::kSeconds
                 ? time_s * form.time.unit_s
                 : from_spreadsheet_days(time_s) - form.time.utc_offset_s.value_or(0.0);
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
