#pragma once
/// Items whose results depend on files that may not change while the work goes on, perhaps in several sessions.

#include <optional>
#include <string>
#include <vector>

#include "api/campaign_definition.h"
#include "campaigns/items.h"

namespace rollrig {

class WatchedItems : public campaigns::ItemList {
 public:
  /// To be called before the first item is carried out. Throws InputError where one of the files has changed.
  void watch_files(const std::vector<CampaignFile>& files) { watch_.emplace(files); }
  void require_unchanged() const override {
    if (watch_.has_value()) watch_->require_unchanged();
  }

 protected:
  bool knows(const std::string& file) const { return watch_.has_value() && watch_->knows(file); }
  /// Throws CampaignChanged for a file that is not watched.
  void require_known(const std::vector<std::string>& files) const {
    if (watch_.has_value()) watch_->require_known(files);
  }
  /// Throws CampaignChanged for one of these files that has changed.
  void require_unchanged_files(const std::vector<std::string>& files) const {
    if (watch_.has_value()) watch_->require_unchanged(files);
  }

 private:
  std::optional<FileWatch> watch_;
};

/// Files with their SHA-256.
std::vector<CampaignFile> hash_files(const std::vector<std::string>& paths);

}  // namespace rollrig
