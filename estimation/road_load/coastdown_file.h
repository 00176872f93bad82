#pragma once
/// Coastdowns from a CSV file: a time trace, or times through speed bins. See docs/formats.md.

#include <string>
#include <vector>

#include "estimation/road_load/coastdown_data.h"

namespace rollrig::estimation {

struct CoastdownFile {
  CoastdownData data;
  bool is_trace = false;
  std::size_t rows_off = 0;                  // left out by `use`
  std::vector<std::string> ignored_columns;  // of a bins file
};

/// Reads either form, told apart by its columns.
/// Errors   InputError: a wrong or missing column, times that do not increase within a run, a run whose speed
///          does not fall, bins that rise or overlap, times through a bin that are not positive
/// Checked  tests/estimation/coastdown_file_test.cpp, tests/cli/bad_input_test.cpp
CoastdownFile read_coastdowns(const std::string& path);

}  // namespace rollrig::estimation
