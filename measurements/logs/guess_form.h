#pragma once
/// How a logger wrote a file, guessed from the file alone.

#include <optional>
#include <string>
#include <vector>

#include "sim/core/csv.h"

namespace rollrig::measurements {

struct GuessedForm {
  CsvForm csv;
  std::vector<std::string> headings;
  std::vector<std::string> units;    // of a row of units below the headings; empty where there is no such row
  bool has_decimals = false;         // else no number tells the decimal sign
  std::vector<std::string> missing;  // what stands in the place of numbers

  bool operator==(const GuessedForm& other) const;
};

/// Separator, decimal sign, line of the headings, row of units and first row of a file.
/// Errors   InputError: no separator gives rows of one length, no line of headings, numbers with both decimal signs
/// Checked  tests/measurements/logs/guess_test.cpp
GuessedForm guess_form(const std::string& path);

/// A number with this decimal sign, blanks around it or not.
std::optional<double> parse_log_number(const std::string& cell, char decimal);

/// The columns of the file as text. Throws InputError as CsvTable::read does.
CsvTable read_guessed_table(const std::string& path, const GuessedForm& form);

}  // namespace rollrig::measurements
