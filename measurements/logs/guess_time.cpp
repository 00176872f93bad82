// The time column of logs, and what its stamps mean.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "measurements/logs/guess.h"
#include "measurements/logs/time_stamps.h"
#include "sim/core/error.h"
#include "sim/core/text_cursor.h"

namespace rollrig::measurements {
namespace {

constexpr const char* kNoDay = "2000-01-01";  // of times of day without a date

/// What the cells of a column are.
enum class StampKind { kNone, kIso8601, kDateAndTime, kDate, kClock, kNumber };

/// The separators of a date, as in "05.03.2024"; empty where the text is none.
std::string take_date(TextCursor& cursor) {
  std::string separators;
  if (!cursor.take_digits(1, 4).has_value()) return {};
  for (const std::size_t most : {2U, 4U}) {
    const char separator = cursor.take_one_of("-./");
    if (separator == '\0' || !cursor.take_digits(1, most).has_value()) return {};
    separators += separator;
  }
  return separators;
}

/// "13:29" or "13:29:42.464", with so many digits behind the point.
bool take_clock(TextCursor& cursor, std::size_t most_decimals) {
  if (!cursor.take_digits(1, 2).has_value() || !cursor.take(':') || !cursor.take_digits(2, 2).has_value()) return false;
  if (!cursor.take(':')) return true;
  if (!cursor.take_digits(2, 2).has_value()) return false;
  return cursor.take_one_of(".,") == '\0' || cursor.take_digits(1, most_decimals).has_value();
}

bool take_offset(TextCursor& cursor) {
  if (cursor.at_end() || cursor.take('Z')) return true;
  if (cursor.take_one_of("+-") == '\0') return false;
  const std::string digits = cursor.take_digits(2, 4).value_or("");
  if (digits.size() == 2 && cursor.take(':')) return cursor.take_digits(2, 2).has_value();
  return digits.size() == 2 || digits.size() == 4;
}

bool is_iso(const std::string& cell) {
  constexpr std::size_t kDate = 10;  // characters of 2024-03-05
  if (cell.size() <= kDate || cell.find_first_not_of("0123456789-") != kDate || cell[4] != '-' || cell[7] != '-') {
    return false;
  }
  TextCursor date(std::string_view(cell).substr(0, kDate)), time(std::string_view(cell).substr(kDate));
  return take_date(date) == "--" && date.at_end() && time.take_one_of("T ") != '\0' && take_clock(time, cell.size()) &&
         take_offset(time) && time.at_end();
}

StampKind find_kind_of_cell(const std::string& cell, char decimal) {
  if (parse_log_number(cell, decimal).has_value()) return StampKind::kNumber;
  if (is_iso(cell)) return StampKind::kIso8601;
  TextCursor cursor(cell);
  if (take_date(cursor).empty()) {
    TextCursor clock(cell);
    return take_clock(clock, 9) && clock.at_end() ? StampKind::kClock : StampKind::kNone;
  }
  if (cursor.at_end()) return StampKind::kDate;
  if (cursor.take_one_of("T, ") == '\0') return StampKind::kNone;
  while (cursor.take_one_of("T, ") != '\0') continue;
  return take_clock(cursor, cell.size()) && cursor.at_end() ? StampKind::kDateAndTime : StampKind::kNone;
}

/// The kind of all cells of a column; kNone where they differ.
StampKind find_kind_of_column(const GuessSource& source, const std::string& heading) {
  StampKind kind = StampKind::kNone;
  for (const GuessedLog& log : source.logs) {
    for (const std::string& cell : log.cells_of(heading)) {
      const StampKind of_cell = find_kind_of_cell(boost::algorithm::trim_copy(cell), source.form.csv.decimal);
      if (of_cell == StampKind::kNone || (kind != StampKind::kNone && of_cell != kind)) return StampKind::kNone;
      kind = of_cell;
    }
  }
  return kind;
}

bool increases_in_all_logs(const GuessSource& source, const std::string& heading) {
  for (const GuessedLog& log : source.logs) {
    double last = -std::numeric_limits<double>::infinity();
    for (const std::string& cell : log.cells_of(heading)) {
      const double number = parse_log_number(cell, source.form.csv.decimal).value_or(last);
      if (number <= last) return false;
      last = number;
    }
  }
  return true;
}

/// Whether a heading is one of time: by its words, or by the heading of sets.
bool is_named_time(const HeadingParts& parts) {
  static const std::set<std::string> words{"time", "zeit",      "uhrzeit",     "t",       "s",
                                           "sec",  "timestamp", "zeitstempel", "elapsed", "messzeit"};
  const std::string name = boost::algorithm::to_lower_copy(parts.name);
  if (parts.unit.has_value() && unit_of_key("value_" + parts.unit->suffix).dimension != dimension::kTime) return false;
  std::vector<std::string> parts_of_name;
  boost::algorithm::split(parts_of_name, name, [](char c) { return c < 'a' || c > 'z'; });
  const auto is_word = [](const std::string& part) { return words.count(part) > 0; };
  return std::any_of(parts_of_name.begin(), parts_of_name.end(), is_word) || name.find("zeit") != std::string::npos ||
         name.find("time") != std::string::npos;
}

std::vector<std::string> list_columns_of(const GuessSource& source, StampKind kind) {
  std::vector<std::string> found;
  for (const std::string& heading : source.form.headings) {
    if (find_kind_of_column(source, heading) != kind) continue;
    if (kind == StampKind::kNumber && !increases_in_all_logs(source, heading)) continue;
    found.push_back(heading);
  }
  return found;
}

/// Order of day, month and year in written dates. Throws InputError where it cannot be told.
std::string find_date_order(const GuessSource& source, const std::string& heading, std::string& reason) {
  if (!source.options.date_order.empty()) {
    reason += "; order of the date as --date-order says";
    return source.options.date_order;
  }
  int first = 0, second = 0;
  char sign = '.';
  for (const GuessedLog& log : source.logs) {
    for (const std::string& cell : log.cells_of(heading)) {
      const std::string trimmed = boost::algorithm::trim_copy(cell);
      TextCursor cursor(trimmed);
      const auto one = cursor.take_digits(1, 4);
      const char separator = cursor.take_one_of("-./");
      const auto two = cursor.take_digits(1, 2);
      const bool is_date = one.has_value() && separator != '\0' && two.has_value() &&
                           cursor.take_one_of("-./") != '\0' && cursor.take_digits(1).has_value();
      if (!is_date) continue;
      if (one->size() == 4) return "ymd";
      first = std::max(first, std::stoi(*one));
      second = std::max(second, std::stoi(*two));
      sign = separator;
    }
  }
  if (first > 12 || sign == '.') {
    reason += first > 12 ? "; day first, since it is above 12" : "; day first, as dates with points are";
    return "dmy";
  }
  if (second > 12) {
    reason += "; month first, since the day is above 12";
    return "mdy";
  }
  throw source.problem("whether day or month stands first in the dates cannot be told", "--date-order",
                       boost::algorithm::trim_copy(source.logs.front().cells_of(heading).front()),
                       "--date-order dmy or --date-order mdy");
}

struct TimeSpan {
  double first = 0.0, step = 0.0, length = 0.0;
};

/// First time, median step and longest duration of the logs, in the unit of the column.
TimeSpan find_time_span(const GuessSource& source, const std::string& heading) {
  TimeSpan span;
  std::vector<double> steps;
  for (const GuessedLog& log : source.logs) {
    std::vector<double> times;
    for (const std::string& cell : log.cells_of(heading)) {
      times.push_back(parse_log_number(cell, source.form.csv.decimal).value_or(0.0));
      if (times.size() > 1) steps.push_back(times.back() - times[times.size() - 2]);
    }
    span.first = std::max(span.first, times.front());
    span.length = std::max(span.length, times.back() - times.front());
  }
  std::sort(steps.begin(), steps.end());
  span.step = steps.empty() ? 0.0 : steps[steps.size() / 2];
  return span;
}

/// Seconds in the unit of a time column, by its heading or by its size.
void find_time_unit(const GuessSource& source, const TimeSpan& span, GuessedTime& time) {
  const auto given = source.options.units.find("time");
  const HeadingParts& parts = source.parts_of(time.heading);
  if (given != source.options.units.end()) {
    time.unit = given->second;
    time.reason += "; unit as --unit says";
  } else if (parts.unit.has_value()) {
    time.unit = parts.unit->suffix;
    time.reason += "; the log states " + parts.unit->written;
  } else if (time.heading != "time_s") {
    for (const char* unit : {"s", "ms", "min"}) {
      const double unit_s = unit_of_key(std::string("time_") + unit).factor;
      const double length_s = span.length * unit_s;
      if (length_s < 60.0 || length_s > 3.0 * kDay_s || span.step * unit_s < 1e-3) continue;
      time.unit = unit;
      time.reason += fmt::format("; no unit is stated: Assumed {}, since the longest log is then {:.4g} min long", unit,
                                 length_s / 60.0);
      return;
    }
    throw source.problem(fmt::format("the unit of the times in '{}' cannot be told", time.heading), "--unit",
                         fmt::format("steps of {:.6g}, {:.6g} in all", span.step, span.length),
                         "--unit time=s, ms, min or h");
  }
}

/// Numbers: days of a spreadsheet, seconds or milliseconds since 1970, or from a start of the log's own.
GuessedTime make_number_time(const GuessSource& source, const std::string& heading, std::string reason) {
  GuessedTime time;
  time.heading = heading;
  time.form = "seconds";
  time.reason = std::move(reason);
  const TimeSpan span = find_time_span(source, heading);
  if (span.first > 30000.0 && span.first < 80000.0 && span.length < 3.0 && !source.parts_of(heading).unit.has_value()) {
    time.form = "spreadsheet_days";
    time.reason += "; days since 1899-12-30, by their size";
    time.is_dated = true;
  } else if (span.first > 5e8 && span.first < 4e9) {
    time.reason += "; seconds since 1970-01-01, by their size";
    time.is_dated = true;
  } else if (span.first > 5e11 && span.first < 4e12) {
    time.unit = "ms";
    time.reason += "; milliseconds since 1970-01-01, by their size";
    time.is_dated = true;
  } else {
    find_time_unit(source, span, time);
  }
  return time;
}

GuessedTime make_clock_time(const GuessSource& source, const std::string& heading) {
  GuessedTime time;
  time.heading = heading;
  time.form = "clock";
  time.reason = "times of day";
  const std::vector<std::string> dates = list_columns_of(source, StampKind::kDate);
  if (dates.empty()) {
    time.date = kNoDay;
    time.reason += "; the logs state no date, so that any day will do";
    return time;
  }
  time.date_heading = dates.front();
  time.date_order = find_date_order(source, time.date_heading, time.reason);
  time.is_dated = true;
  return time;
}

/// A form for stamps with day and time in one cell, if the reader of logs has one.
GuessedTime make_date_and_time(const GuessSource& source, const std::string& heading) {
  const std::vector<std::string>& forms = time_form_names();
  const auto form = std::find(forms.begin(), forms.end(), "date_time");
  if (form == forms.end()) {
    throw source.problem(
        fmt::format("'{}' has date and time in one cell, in a form that the reader does not know", heading), "",
        source.logs.front().cells_of(heading).front(), example_of(TimeForm::kIso8601));
  }
  GuessedTime time;
  time.heading = heading;
  time.form = *form;
  time.is_dated = true;
  time.reason = "date and time";
  time.date_order = find_date_order(source, heading, time.reason);
  return time;
}

GuessedTime make_time_of(const GuessSource& source, const std::string& heading, const std::string& reason) {
  switch (find_kind_of_column(source, heading)) {
    case StampKind::kIso8601:
      return {heading, "iso_8601", "s", "", "", "", true, "date and time"};
    case StampKind::kDateAndTime:
      return make_date_and_time(source, heading);
    case StampKind::kClock:
      return make_clock_time(source, heading);
    case StampKind::kNumber:
      return make_number_time(source, heading, reason);
    case StampKind::kDate:
    case StampKind::kNone:
      break;
  }
  throw source.problem(fmt::format("the cells of '{}' are no times", heading), "--column",
                       source.logs.front().cells_of(heading).front(), "--column \"time=HEADING\"");
}

}  // namespace

GuessedTime guess_time(const GuessSource& source) {
  const auto given = source.options.columns.find("time");
  if (given != source.options.columns.end()) return make_time_of(source, given->second, "as --column says");
  for (const StampKind kind : {StampKind::kIso8601, StampKind::kDateAndTime, StampKind::kClock}) {
    const std::vector<std::string> found = list_columns_of(source, kind);
    if (!found.empty()) return make_time_of(source, found.front(), "");
  }
  const std::vector<std::string> rising = list_columns_of(source, StampKind::kNumber);
  for (const std::string& heading : rising) {
    if (heading == "time_s" || is_named_time(source.parts_of(heading))) {
      return make_time_of(source, heading, "the name, and numbers that increase");
    }
  }
  throw source.problem("no column is told to be the time", "--column",
                       fmt::format("{}", fmt::join(source.form.headings, ", ")),
                       "--column \"time=HEADING\": a column whose values increase from row to row");
}

std::vector<double> read_guessed_times(const GuessSource& source, const GuessedTime& time, const GuessedLog& log) {
  const std::vector<std::string>& stamps = log.cells_of(time.heading);
  std::vector<double> times_s;
  double day_s = 0.0;
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    const std::string stamp = boost::algorithm::trim_copy(stamps[row]);
    try {
      if (time.form == "iso_8601") {
        times_s.push_back(parse_iso_8601(stamp).time_s);
      } else if (time.form == "clock") {
        const std::string date =
            time.date_heading.empty() ? time.date : boost::algorithm::trim_copy(log.cells_of(time.date_heading)[row]);
        const std::string order = time.date_order.empty() ? "ymd" : time.date_order;
        double time_s = parse_date_days(date, order) * kDay_s + parse_clock_s(stamp) + day_s;
        if (time.date_heading.empty() && row > 0 && time_s < times_s.back() - 0.5 * kDay_s) {
          day_s += kDay_s;
          time_s += kDay_s;
        }
        times_s.push_back(time_s);
      } else if (time.form == "date_time") {
        const std::size_t blank = stamp.find_first_of("T ,");
        times_s.push_back(parse_date_days(stamp.substr(0, blank), time.date_order) * kDay_s +
                          parse_clock_s(stamp.substr(stamp.find_first_of("0123456789", blank))));
      } else {
        const std::optional<double> number = parse_log_number(stamp, source.form.csv.decimal);
        if (!number.has_value()) throw std::invalid_argument(fmt::format("'{}' is not a number", stamp));
        times_s.push_back(time.form == "spreadsheet_days" ? from_spreadsheet_days(*number)
                                                          : *number * unit_of_key("time_" + time.unit).factor);
      }
    } catch (const std::invalid_argument& error) {
      throw log.table.cell_error(row, time.heading, fmt::format("a time is not understood: {}", error.what()),
                                 "times as in the other rows");
    }
  }
  return times_s;
}

}  // namespace rollrig::measurements
