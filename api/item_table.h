#pragma once
/// Results of a campaign's items as a table.

#include <algorithm>
#include <string>
#include <vector>

#include "api/run_items.h"

namespace rollrig {

/// Items that are done, a column for each result.
struct ItemTable {
  std::vector<std::size_t> items;                // in their order
  std::vector<std::vector<std::string>> values;  // of each item, of each factor
  std::vector<std::string> results;              // their names; "load_N_2" where a factor is called load_N
  std::vector<std::vector<double>> numbers;      // of each result, NaN where an item has none
  std::vector<std::string> failures;             // empty where the item did not fail

  bool has_failures() const {
    return std::any_of(failures.begin(), failures.end(), [](const std::string& text) { return !text.empty(); });
  }
};

/// Reads files of results twice, the first time for the names of the results. Throws InputError as
/// campaigns::read_records() does.
ItemTable read_item_table(const std::vector<std::string>& files, const std::string& definition, const RunItems& items);

}  // namespace rollrig
