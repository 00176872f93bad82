#include "measurements/logs/time_stamps.h"

#include <cctype>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/date_time/gregorian/gregorian.hpp>

#include "sim/core/text.h"
#include "sim/core/text_cursor.h"

namespace rollrig::measurements {
namespace {

namespace gregorian = boost::gregorian;

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw std::invalid_argument(fmt::format("'{}' {}", shorten(text, 60), what));
}

/// Day, month and year in the order in which they are written. The month may be a word.
struct WrittenDate {
  std::string first, month, last;
};

/// Day, month and year with -, ., / or a blank between them: "05.03.2024", "5 Mar 2024".
std::optional<WrittenDate> split_date(const std::string& text) {
  TextCursor cursor(text);
  const auto take_separator = [&cursor] {
    const bool is_there = cursor.take_one_of("-./ ") != '\0';
    cursor.skip_blanks();
    return is_there;
  };
  const auto first = cursor.take_digits(1, 4);
  if (!first.has_value() || !take_separator()) return std::nullopt;
  auto month = cursor.take_digits(1, 2);
  if (!month.has_value()) month = cursor.take_letters(3, 9);
  if (!month.has_value() || !take_separator()) return std::nullopt;
  const auto last = cursor.take_digits(1, 4);
  if (!last.has_value() || !cursor.at_end()) return std::nullopt;
  return WrittenDate{*first, *month, *last};
}

struct WrittenClock {
  std::string hour, minute, second, fraction;  // the last two may be empty; the fraction begins with its sign
  char half = '\0';                            // a or p, of AM and PM
};

/// ":42.464", if it is there. Returns whether the text is right so far.
bool take_seconds(TextCursor& cursor, WrittenClock& clock) {
  if (!cursor.take(':')) return true;
  const auto second = cursor.take_digits(2, 2);
  if (!second.has_value()) return false;
  clock.second = *second;
  const char sign = cursor.take_one_of(".,");
  if (sign == '\0') return true;
  const auto fraction = cursor.take_digits(1, 9);
  if (fraction.has_value()) clock.fraction = sign + *fraction;
  return fraction.has_value();
}

/// "13:29", "13:29:42.464", "1:29:42 p.m."
std::optional<WrittenClock> split_clock(const std::string& text) {
  TextCursor cursor(text);
  WrittenClock clock;
  const auto hour = cursor.take_digits(1, 2);
  if (!hour.has_value() || !cursor.take(':')) return std::nullopt;
  const auto minute = cursor.take_digits(2, 2);
  if (!minute.has_value() || !take_seconds(cursor, clock)) return std::nullopt;
  clock.hour = *hour;
  clock.minute = *minute;
  if (cursor.at_end()) return clock;
  cursor.skip_blanks();
  clock.half = static_cast<char>(std::tolower(cursor.take_one_of("AaPp")));
  cursor.take('.');
  const bool has_half = clock.half != '\0' && cursor.take_one_of("Mm") != '\0';
  cursor.take('.');
  if (!has_half || !cursor.at_end()) return std::nullopt;
  return clock;
}

/// The offset to UTC behind a time: Z, +01, +0100, +01:00 or nothing. Returns whether it is one.
bool read_offset(const std::string& text, IsoStamp& stamp, double& offset_s) {
  TextCursor cursor(text);
  stamp.has_offset = !cursor.at_end();
  if (!stamp.has_offset || cursor.take('Z')) return cursor.at_end();
  const char sign = cursor.take_one_of("+-");
  std::string digits = cursor.take_digits(2, 4).value_or("");
  if (digits.size() == 2 && cursor.take(':')) digits += cursor.take_digits(2, 2).value_or("?");
  if (sign == '\0' || digits.size() % 2 != 0 || digits.empty() || !cursor.at_end()) return false;
  const int minutes = digits.size() == 4 ? std::stoi(digits.substr(2)) : 0;
  offset_s = (sign == '-' ? -1.0 : 1.0) * (3600.0 * std::stoi(digits.substr(0, 2)) + 60.0 * minutes);
  return true;
}

struct DateAndTime {
  std::string date, clock;
};

/// The last place at which a date can end and a time of day begin: between them are blanks, a comma or a T.
std::optional<DateAndTime> split_date_and_time(const std::string& text) {
  constexpr const char* kDigits = "0123456789";
  for (std::size_t colon = text.rfind(':'); colon != std::string::npos && colon > 0;
       colon = text.rfind(':', colon - 1)) {
    const std::size_t before = text.find_last_not_of(kDigits, colon - 1);
    if (before == std::string::npos || colon - before < 2 || colon - before > 3) continue;
    if (text.find_first_not_of(kDigits, colon + 1) < colon + 3 || text.size() < colon + 3) continue;
    std::size_t end = text[before] == 'T' ? before : text.find_last_not_of(kBlanks, before) + 1;
    if (end > 0 && text[before] != 'T' && text[end - 1] == ',') end = text.find_last_not_of(kBlanks, end - 2) + 1;
    const bool is_split = end > 0 && end <= before && std::isdigit(static_cast<unsigned char>(text[end - 1])) != 0;
    if (is_split) return DateAndTime{text.substr(0, end), text.substr(before + 1)};
  }
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& time_form_names() {
  static const std::vector<std::string> names{"seconds",          "iso_8601",      "clock",
                                              "spreadsheet_days", "epoch_seconds", "date_time"};
  return names;
}

bool is_number(TimeForm form) {
  return form == TimeForm::kSeconds || form == TimeForm::kSpreadsheetDays || form == TimeForm::kEpochSeconds;
}

const std::vector<std::string>& date_orders() {
  static const std::vector<std::string> orders{"ymd", "dmy", "mdy"};
  return orders;
}

double parse_date_days(const std::string& text, const std::string& order) {
  const auto written = split_date(text);
  if (!written.has_value()) refuse(text, "is not a date");
  const auto& [first_part, month, last_part] = *written;
  const bool has_word = std::isalpha(static_cast<unsigned char>(month[0])) != 0;
  const std::string read_as = !has_word ? order : first_part.size() == 4 ? "ymd" : "dmy";
  constexpr int kCentury = 2000;  // Assumed: of a year of two digits
  const auto year_of = [](const std::string& digits) {
    return digits.size() == 2 ? std::to_string(kCentury + std::stoi(digits)) : digits;
  };
  const std::string year = year_of(read_as == "ymd" ? first_part : last_part);
  const std::string first = read_as == "mdy" ? month : read_as == "dmy" ? first_part : last_part;
  const std::string middle = read_as == "mdy" ? first_part : month;
  try {
    const gregorian::date date = gregorian::from_string(fmt::format("{}-{}-{}", year, middle, first));
    return static_cast<double>((date - gregorian::date(1970, 1, 1)).days());
  } catch (const std::exception&) {
    refuse(text, fmt::format("is no day of the calendar (read in the order {})", read_as));
  }
}

double parse_clock_s(const std::string& text) {
  const auto written = split_clock(text);
  if (!written.has_value()) refuse(text, "is not a time of day");
  const bool has_half = written->half != '\0';
  int hour = std::stoi(written->hour);
  const int minute = std::stoi(written->minute);
  const int second = written->second.empty() ? 0 : std::stoi(written->second);
  const bool is_hour = has_half ? hour >= 1 && hour <= 12 : hour <= 23;
  if (!is_hour || minute > 59 || second > 59) refuse(text, "is no time of day");
  if (has_half) hour = hour % 12 + (written->half == 'p' ? 12 : 0);
  std::string fraction = written->fraction.empty() ? ".0" : written->fraction;
  fraction.front() = '.';
  return 3600.0 * hour + 60.0 * minute + second + parse_number("0" + fraction).value_or(0.0);
}

double parse_date_time_s(const std::string& text, const std::string& order) {
  const auto written = split_date_and_time(text);
  if (!written.has_value()) refuse(text, "is not a date and a time");
  return parse_date_days(written->date, order) * kDay_s + parse_clock_s(written->clock);
}

IsoStamp parse_iso_8601(const std::string& text) {
  constexpr std::size_t kDate = 10;  // characters of 2024-03-05
  const std::size_t end = std::min(text.find_first_not_of("0123456789:.,", kDate + 1), text.size());
  const bool has_form = text.size() > kDate && text.find_first_not_of("0123456789-") == kDate && text[4] == '-' &&
                        text[7] == '-' && (text[kDate] == 'T' || text[kDate] == ' ') && end > kDate + 1;
  IsoStamp stamp;
  double offset_s = 0.0;
  if (!has_form || !read_offset(text.substr(std::min(end, text.size())), stamp, offset_s)) {
    refuse(text, "is not a time stamp of ISO 8601");
  }
  stamp.time_s = parse_date_days(text.substr(0, kDate), "ymd") * kDay_s +
                 parse_clock_s(text.substr(kDate + 1, end - kDate - 1)) - offset_s;
  return stamp;
}

double from_spreadsheet_days(double days) {
  constexpr double kDaysTo1970 = 25569.0;  // 1899-12-30 to 1970-01-01
  return (days - kDaysTo1970) * kDay_s;
}

std::string example_of(TimeForm form) {
  switch (form) {
    case TimeForm::kSeconds:
      return "a number";
    case TimeForm::kIso8601:
      return "2024-03-05T13:29:42.464, with Z or an offset such as +01:00 or without";
    case TimeForm::kClock:
      return "13:29:42.464 or 13:29:42,464";
    case TimeForm::kSpreadsheetDays:
      return "days since 1899-12-30, such as 45356.5623";
    case TimeForm::kEpochSeconds:
      return "a number of seconds since 1970-01-01, such as 1709641782.46";
    case TimeForm::kDateTime:
      return "2024-03-05 13:29:42, 05.03.2024 13:29:42,5 or 3/5/2024 1:29:42 PM, with date_order";
  }
  return {};
}

}  // namespace rollrig::measurements
