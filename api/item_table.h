#pragma once
/// Results of a campaign's items as a table.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "api/campaign_items.h"

namespace rollrig {

/// Where the results of a campaign are.
struct ItemFiles {
  std::vector<std::string> paths;
  std::string definition;
};

/// The columns of a table of items that are done.
struct ItemColumns {
  std::vector<std::string> results;       // their names; "load_N_2" where a factor is called load_N
  std::vector<std::string> text_results;  // likewise of results that are texts
  bool has_failures = false;
  std::vector<bool> is_known;                 // which items are in the table: a process may add some while it is read
  std::map<std::string, std::size_t> places;  // of results and text results, by their keys
};

/// A row of the table.
struct ItemRow {
  std::size_t item = 0;
  std::vector<std::string> values;  // of each factor
  std::vector<double> numbers;      // of each result, NaN where the item has none
  std::vector<std::string> texts;   // of each text result, empty where it has none
  std::string failure;              // empty where the item did not fail
};

/// Reads the files for the names of all results, which `items` learns. Throws InputError as campaigns::read_records()
/// does.
ItemColumns find_item_columns(const ItemFiles& files, CampaignItems& items);

/// Calls `visit` for each row in order of the items. Throws InputError likewise.
void visit_item_rows(const ItemFiles& files, const CampaignItems& items, const ItemColumns& columns,
                     const std::function<void(const ItemRow&)>& visit);

/// All of a table, by columns.
struct ItemTable {
  ItemColumns columns;
  std::vector<std::size_t> items;                // in their order
  std::vector<std::vector<std::string>> values;  // of each item, of each factor
  std::vector<std::vector<double>> numbers;      // of each result
  std::vector<std::vector<std::string>> texts;   // of each text result
  std::vector<std::string> failures;
};
ItemTable read_item_table(const ItemFiles& files, CampaignItems& items);

/// Throws InputError for a record of an item that the campaign does not have. `path` is for the message.
void require_item(const campaigns::Record& record, std::size_t items, const std::string& path);

}  // namespace rollrig
