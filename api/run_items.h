#pragma once
/// The runs of a campaign as items.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/campaign_definition.h"
#include "campaigns/items.h"
#include "scenarios/run/scenario.h"

namespace rollrig {

class RunItems : public campaigns::ItemList {
 public:
  /// Throws InputError for a design that cannot be made.
  explicit RunItems(const CampaignDefinition& definition);

  /// Throws InputError where a file of the campaign has changed. To be called before the first item is carried out.
  void watch_files(const std::vector<CampaignFile>& files) { watch_.emplace(files); }
  void require_unchanged() const override {
    if (watch_.has_value()) watch_->require_unchanged();
  }

  std::size_t count() const override { return design_->count_items(); }
  Json describe(std::size_t item) const override;
  Json carry_out(std::size_t item, std::uint64_t seed) const override;

  /// The keys of the factors.
  std::vector<std::string> list_keys() const;
  /// The value of each factor.
  std::vector<std::string> calc_values(std::size_t item) const { return design_->calc_values(item); }
  /// Reads and prepares items: of a grid its first and its last item and one with each word or path that a factor
  /// takes, of draws the item at the median of each factor. Carries out one item, in the quicker fidelity. Returns the
  /// files that were read. Throws InputError where one of the items is wrong.
  std::vector<CampaignFile> check() const;

 private:
  scenarios::RunSpec read(const std::vector<std::string>& values, std::uint64_t seed) const;

  RunInput run_;
  std::vector<campaigns::Factor> factors_;
  std::unique_ptr<campaigns::Design> design_;
  std::optional<FileWatch> watch_;
};

}  // namespace rollrig
