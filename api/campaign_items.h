#pragma once
/// The items of a campaign of either kind, with what their table shows.

#include <memory>
#include <string>
#include <vector>

#include "api/watched_items.h"

namespace rollrig {

class CampaignItems : public WatchedItems {
 public:
  /// What is found before any item is carried out.
  struct Check {
    std::vector<CampaignFile> files;    // that the items read
    std::vector<std::string> warnings;  // of items that will fail, a text each
  };
  /// Throws InputError where one of the items of a design, or each of the sets, is wrong, as far as that can be told
  /// without carrying out all of them.
  virtual Check check() const = 0;
  /// The same of one item alone: for each process that begins, after check() has passed. Throws InputError where the
  /// items cannot be carried out here. `has_same_assets`: all files of the campaign are in the present folder of assets,
  /// so that no item can miss one.
  virtual void check_briefly(bool has_same_assets) const = 0;

  /// Names of the columns that identify an item, and their values for one item.
  virtual std::vector<std::string> list_keys() const = 0;
  virtual std::vector<std::string> calc_values(std::size_t item) const = 0;
  /// Takes the names of a result's numbers. To be called with all results before the first is flattened.
  virtual void learn_names(const Json&) {}
  /// A result as an object of numbers and texts, for the columns of a table. Throws InputError where it is damaged.
  virtual Json flatten(const Json& result) const = 0;
};

/// Runs or diagnoses. Throws InputError for a design that cannot be made.
std::unique_ptr<CampaignItems> make_items(const CampaignDefinition& definition);

}  // namespace rollrig
