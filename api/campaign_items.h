#pragma once
/// The items of a campaign of either kind, with what their table shows.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/campaign_definition.h"
#include "campaigns/items.h"

namespace rollrig {

class CampaignItems : public campaigns::ItemList {
 public:
  /// Throws InputError where a file of the campaign has changed. To be called before the first item is carried out.
  void watch_files(const std::vector<CampaignFile>& files) { watch_.emplace(files); }
  void require_unchanged() const override {
    if (watch_.has_value()) watch_->require_unchanged();
  }

  /// The files that the items read. Throws InputError where one of the items is wrong, as far as that can be told
  /// without carrying out all of them.
  virtual std::vector<CampaignFile> check() const = 0;
  /// What tells items from each other: names, and the values of an item.
  virtual std::vector<std::string> list_keys() const = 0;
  virtual std::vector<std::string> calc_values(std::size_t item) const = 0;
  /// A result as an object of numbers and texts, for the columns of a table. To be used once all results are learned.
  virtual void learn_names(const Json&) {}
  virtual Json flatten(const Json& result) const = 0;

 protected:
  /// Throws CampaignChanged for a file that is none of the campaign's.
  void require_known(const std::vector<std::string>& files) const {
    if (watch_.has_value()) watch_->require_known(files);
  }
  bool knows(const std::string& file) const { return watch_.has_value() && watch_->knows(file); }

 private:
  std::optional<FileWatch> watch_;
};

/// Runs or diagnoses. Throws InputError for a design that cannot be made.
std::unique_ptr<CampaignItems> make_items(const CampaignDefinition& definition);

/// Files with their SHA-256.
std::vector<CampaignFile> hash_files(const std::vector<std::string>& paths);

}  // namespace rollrig
