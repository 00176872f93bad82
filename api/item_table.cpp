#include "api/item_table.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "campaigns/store.h"
#include "exports/tree.h"
#include "scenarios/run/flat_results.h"
#include "sim/core/error.h"
#include "sim/core/parse_json.h"

namespace rollrig {

namespace {

Json read_result(const campaigns::Record& record) {
  return parse_json(record.result, fmt::format("result of item {}", record.item + 1));
}

}  // namespace

ItemTable read_item_table(const std::vector<std::string>& files, const std::string& definition, const RunItems& items) {
  scenarios::ResultFlattener flattener;
  std::vector<bool> is_known(items.count());  // a process may add records while this reads
  campaigns::read_records(files, definition, [&](const campaigns::Record& record) {
    if (record.item >= is_known.size()) {
      throw InputError({fmt::format("the results have an item {} of {}", record.item + 1, is_known.size()),
                        files.front(), 0, "", "", "items that the campaign has", ""});
    }
    is_known[record.item] = true;
    if (record.failure.empty()) flattener.learn_names(read_result(record));
  });
  ItemTable table;
  std::map<std::string, std::size_t> places;
  std::set<std::string> names{"item", "failure"};  // of columns
  for (const std::string& key : items.list_keys()) names.insert(key);
  campaigns::read_records(files, definition, [&](const campaigns::Record& record) {
    if (record.item >= is_known.size() || !is_known[record.item]) return;
    const std::size_t row = table.items.size();
    table.items.push_back(record.item);
    table.values.push_back(items.calc_values(record.item));
    table.failures.push_back(record.failure);
    for (std::vector<double>& column : table.numbers) column.push_back(std::nan(""));
    if (!record.failure.empty()) return;
    const Json flat = flattener.flatten(read_result(record));
    for (const auto& [key, value] : flat.items()) {
      const auto [place, is_new] = places.emplace(key, table.results.size());
      if (is_new) {
        table.results.push_back(exports::take_name(key, names));
        table.numbers.emplace_back(row + 1, std::nan(""));
      }
      table.numbers[place->second][row] = value.get<double>();
    }
  });
  return table;
}

}  // namespace rollrig
