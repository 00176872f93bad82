#include "api/item_table.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "campaigns/store.h"
#include "exports/tree.h"
#include "sim/core/error.h"
#include "sim/core/parse_json.h"

namespace rollrig {

namespace {

Json read_result(const campaigns::Record& record) {
  return parse_json(record.result, fmt::format("result of item {}", record.item + 1));
}

}  // namespace

void require_item(const campaigns::Record& record, std::size_t items, const std::string& path) {
  if (record.item < items) return;
  throw InputError({fmt::format("the results have an item {} of {}", record.item + 1, items), path, 0, "", "",
                    "items that the campaign has", ""});
}

ItemColumns find_item_columns(const ItemFiles& files, CampaignItems& items) {
  ItemColumns columns;
  columns.is_known.resize(items.count());
  campaigns::read_records(files.paths, files.definition, [&](const campaigns::Record& record) {
    require_item(record, items.count(), files.paths.front());
    columns.is_known[record.item] = true;
    if (record.failure.empty()) {
      items.learn_names(read_result(record));
    } else {
      columns.has_failures = true;
    }
  });
  std::set<std::string> names{"item", "failure"};  // of columns
  for (const std::string& key : items.list_keys()) names.insert(key);
  campaigns::read_records(files.paths, files.definition, [&](const campaigns::Record& record) {
    if (record.item >= items.count() || !columns.is_known[record.item] || !record.failure.empty()) return;
    const Json flat = items.flatten(read_result(record));
    for (const auto& [key, value] : flat.items()) {
      std::vector<std::string>& of_kind = value.is_string() ? columns.text_results : columns.results;
      const bool is_new = columns.places.emplace(key, of_kind.size()).second;
      if (is_new) of_kind.push_back(exports::take_name(key, names));
    }
  });
  return columns;
}

void visit_item_rows(const ItemFiles& files, const CampaignItems& items, const ItemColumns& columns,
                     const std::function<void(const ItemRow&)>& visit) {
  campaigns::read_records(files.paths, files.definition, [&](const campaigns::Record& record) {
    if (record.item >= items.count() || !columns.is_known[record.item]) return;
    ItemRow row{record.item, items.calc_values(record.item), {}, {}, record.failure};
    row.numbers.assign(columns.results.size(), std::nan(""));
    row.texts.resize(columns.text_results.size());
    if (record.failure.empty()) {
      const Json flat = items.flatten(read_result(record));
      for (const auto& [key, value] : flat.items()) {
        const std::size_t place = columns.places.at(key);
        if (value.is_string()) {
          row.texts[place] = value.get<std::string>();
        } else {
          row.numbers[place] = value.get<double>();
        }
      }
    }
    visit(row);
  });
}

ItemTable read_item_table(const ItemFiles& files, CampaignItems& items) {
  ItemTable table;
  table.columns = find_item_columns(files, items);
  table.numbers.resize(table.columns.results.size());
  table.texts.resize(table.columns.text_results.size());
  visit_item_rows(files, items, table.columns, [&table](const ItemRow& row) {
    table.items.push_back(row.item);
    table.values.push_back(row.values);
    for (std::size_t i = 0; i < row.numbers.size(); ++i) table.numbers[i].push_back(row.numbers[i]);
    for (std::size_t i = 0; i < row.texts.size(); ++i) table.texts[i].push_back(row.texts[i]);
    table.failures.push_back(row.failure);
  });
  return table;
}

}  // namespace rollrig
