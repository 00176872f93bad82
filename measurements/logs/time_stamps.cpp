#include "measurements/logs/time_stamps.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/date_time/gregorian/gregorian.hpp>
#include <boost/date_time/posix_time/posix_time_duration.hpp>
#include <boost/date_time/posix_time/time_parsers.hpp>

namespace rollrig::measurements {
namespace {

namespace gregorian = boost::gregorian;

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw std::invalid_argument(fmt::format("'{}' {}", text, what));
}

}  // namespace

const std::vector<std::string>& time_form_names() {
  static const std::vector<std::string> names{"seconds", "iso_8601", "clock", "spreadsheet_days"};
  return names;
}

const std::vector<std::string>& date_orders() {
  static const std::vector<std::string> orders{"ymd", "dmy", "mdy"};
  return orders;
}

double parse_date_days(const std::string& text, const std::string& order) {
  static const std::regex shape(R"(\d{1,4}[-./]\d{1,2}[-./]\d{1,4})");
  if (!std::regex_match(text, shape)) refuse(text, "is not a date");
  try {
    const gregorian::date date = order == "dmy"   ? gregorian::from_uk_string(text)
                                 : order == "mdy" ? gregorian::from_us_string(text)
                                                  : gregorian::from_string(text);
    return static_cast<double>((date - gregorian::date(1970, 1, 1)).days());
  } catch (const std::exception&) {
    refuse(text, fmt::format("is no day of the calendar (read in the order {})", order));
  }
}

double parse_clock_s(const std::string& text) {
  static const std::regex shape(R"((\d{1,2}):(\d{2})(:(\d{2})([.,]\d{1,9})?)?)");
  std::smatch match;
  if (!std::regex_match(text, match, shape)) refuse(text, "is not a time of day");
  if (std::stoi(match[1]) > 23 || std::stoi(match[2]) > 59 || (match[4].matched && std::stoi(match[4]) > 59)) {
    refuse(text, "is no time of day");
  }
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), ',', '.');
  const boost::posix_time::time_duration time = boost::posix_time::duration_from_string(plain);
  return static_cast<double>(time.total_microseconds()) * 1e-6;
}

IsoStamp parse_iso_8601(const std::string& text) {
  static const std::regex shape(R"((\d{4}-\d{2}-\d{2})[T ]([0-9:.,]+)(Z|[+-]\d{2}(:?\d{2})?)?)");
  std::smatch match;
  if (!std::regex_match(text, match, shape)) refuse(text, "is not a time stamp of ISO 8601");
  IsoStamp stamp;
  stamp.time_s = parse_date_days(match[1], "ymd") * kDay_s + parse_clock_s(match[2]);
  const std::string offset = match[3];
  stamp.has_offset = !offset.empty();
  if (offset.size() > 1) {
    const int minutes = match[4].matched ? std::stoi(offset.substr(offset.size() - 2)) : 0;
    const double sign = offset[0] == '-' ? -1.0 : 1.0;
    stamp.time_s -= sign * (3600.0 * std::stoi(offset.substr(1, 2)) + 60.0 * minutes);
  }
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
  }
  return {};
}

}  // namespace rollrig::measurements
