#include "measurements/logs/time_stamps.h"

#include <cctype>
#include <regex>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/date_time/gregorian/gregorian.hpp>

#include "sim/core/text.h"

namespace rollrig::measurements {
namespace {

namespace gregorian = boost::gregorian;

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw std::invalid_argument(fmt::format("'{}' {}", text, what));
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
  static const std::regex shape(R"((\d{1,4})[-./ ]\s*(\d{1,2}|[A-Za-z]{3,9})[-./ ]\s*(\d{1,4}))");
  std::smatch match;
  if (!std::regex_match(text, match, shape)) refuse(text, "is not a date");
  const std::string month = match[2];
  const bool has_word = std::isalpha(static_cast<unsigned char>(month[0])) != 0;
  const std::string read_as = !has_word ? order : match[1].length() == 4 ? "ymd" : "dmy";
  constexpr int kCentury = 2000;  // Assumed: of a year of two digits
  const auto year_of = [](const std::string& digits) {
    return digits.size() == 2 ? std::to_string(kCentury + std::stoi(digits)) : digits;
  };
  const std::string year = year_of(read_as == "ymd" ? match[1] : match[3]);
  const std::string first = read_as == "mdy" ? month : read_as == "dmy" ? match[1].str() : match[3].str();
  const std::string middle = read_as == "mdy" ? match[1].str() : month;
  try {
    const gregorian::date date = gregorian::from_string(fmt::format("{}-{}-{}", year, middle, first));
    return static_cast<double>((date - gregorian::date(1970, 1, 1)).days());
  } catch (const std::exception&) {
    refuse(text, fmt::format("is no day of the calendar (read in the order {})", read_as));
  }
}

double parse_clock_s(const std::string& text) {
  static const std::regex shape(R"((\d{1,2}):(\d{2})(:(\d{2})([.,]\d{1,9})?)?(\s*([AaPp])\.?[Mm]\.?)?)");
  std::smatch match;
  if (!std::regex_match(text, match, shape)) refuse(text, "is not a time of day");
  const bool has_half = match[7].matched;  // AM or PM
  int hour = std::stoi(match[1]);
  const bool is_hour = has_half ? hour >= 1 && hour <= 12 : hour <= 23;
  if (!is_hour || std::stoi(match[2]) > 59 || (match[4].matched && std::stoi(match[4]) > 59)) {
    refuse(text, "is no time of day");
  }
  if (has_half) hour = hour % 12 + (match[7] == "p" || match[7] == "P" ? 12 : 0);
  const std::string seconds = match[4].matched ? match[4].str() : "0";
  std::string fraction = match[5].matched ? match[5].str() : ".0";
  fraction.front() = '.';
  return 3600.0 * hour + 60.0 * std::stoi(match[2]) + std::stoi(seconds) + parse_number("0" + fraction).value_or(0.0);
}

double parse_date_time_s(const std::string& text, const std::string& order) {
  static const std::regex shape(R"((.*\d)(?:\s*,\s*|\s+|T)(\d{1,2}:\d{2}.*))");
  std::smatch match;
  if (!std::regex_match(text, match, shape)) refuse(text, "is not a date and a time");
  return parse_date_days(match[1], order) * kDay_s + parse_clock_s(match[2]);
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
    case TimeForm::kEpochSeconds:
      return "a number of seconds since 1970-01-01, such as 1709641782.46";
    case TimeForm::kDateTime:
      return "2024-03-05 13:29:42, 05.03.2024 13:29:42,5 or 3/5/2024 1:29:42 PM, with date_order";
  }
  return {};
}

}  // namespace rollrig::measurements
