#pragma once
/// Time stamps of loggers as seconds.

#include <string>
#include <vector>

namespace rollrig::measurements {

inline constexpr double kDay_s = 86400.0;

enum class TimeForm { kSeconds, kIso8601, kClock, kSpreadsheetDays, kEpochSeconds, kDateTime };

/// Names of the forms as a mapping file has them, in the order of TimeForm.
const std::vector<std::string>& time_form_names();

/// Whether times of a form are numbers; the others are text.
bool is_number(TimeForm form);

/// Order of year, month and day in a written date: "ymd", "dmy" or "mdy".
const std::vector<std::string>& date_orders();

/// A written date as days since 1970-01-01: "2024-03-05", "05.03.2024", "3/5/24", "05-Mar-2024". A year of two digits
/// is one of this century; a month that is a word is read whatever the order says. Throws std::invalid_argument, which
/// says what is wrong.
double parse_date_days(const std::string& text, const std::string& order);

/// "13:29:42.464", "13:29:42,464", "13:29" or "1:29:42 PM" as seconds of the day. Throws std::invalid_argument.
double parse_clock_s(const std::string& text);

struct IsoStamp {
  double time_s = 0.0;  // since 1970-01-01, as written: in UTC only where the stamp says its offset
  bool has_offset = false;
};

/// "2024-03-05T13:29:42.464+01:00"; a blank for the T, Z or an offset or none. An offset is taken off.
/// Throws std::invalid_argument.
IsoStamp parse_iso_8601(const std::string& text);

/// Date and time in one text, "05.03.2024 13:29:42,5", as seconds since 1970-01-01 on the clock that wrote it.
/// Throws std::invalid_argument.
double parse_date_time_s(const std::string& text, const std::string& order);

/// Days of a spreadsheet, counted from 1899-12-30, as seconds since 1970-01-01.
double from_spreadsheet_days(double days);

/// What an example of a form looks like, for messages.
std::string example_of(TimeForm form);

}  // namespace rollrig::measurements
