#pragma once
/// A measurement set of the drum as another laboratory might have logged it.

#include <cstdint>
#include <string>

#include "measurements/measurement_set.h"

namespace rollrig::tests {

/// How a logger writes its files.
struct LoggerStyle {
  enum class Time { kSeconds, kMilliseconds, kMinutes, kIso8601, kClockAndDate, kSpreadsheetDays, kEpochSeconds };
  enum class Units { kBrackets, kParentheses, kSlash, kUnderscore, kRow, kNone };

  bool is_german = false;
  char separator = ',';
  char decimal = '.';
  Time time = Time::kSeconds;
  Units units = Units::kBrackets;
  int wording = 0;  // 0 to 2: long names, other names, short names
  std::string speed_unit = "km/h";
  std::string load_unit = "N";
  std::string temperature_unit = "degC";
  std::string pressure_unit = "bar";
  int lines_above = 0;       // remarks above the headings
  std::string gap_word;      // in cells without a value
  bool counts_rows = false;  // a column with the number of the row
  int every = 1;             // of the rows of the set, one in so many
};

/// One of many styles, by a seed.
LoggerStyle make_logger_style(std::uint64_t seed);
/// The style in words, for messages.
std::string describe(const LoggerStyle& style);

/// Whether the times say the day.
bool is_dated(const LoggerStyle& style);

/// Writes a file for each run into a folder, one after the other: a rest as the set has it, or the next day.
void write_foreign_logs(const measurements::MeasurementSet& set, const LoggerStyle& style, const std::string& folder);

}  // namespace rollrig::tests
