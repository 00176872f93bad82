#pragma once
/// The runs of a campaign as items.

#include <memory>
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

  std::size_t count() const override { return design_->count_items(); }
  Json describe(std::size_t item) const override;
  Json carry_out(std::size_t item, std::uint64_t seed) const override;

  /// The value of each factor.
  std::vector<std::string> calc_values(std::size_t item) const { return design_->calc_values(item); }
  /// Throws InputError where no item can be carried out: of a grid for its first and its last item, of draws at the
  /// median of each factor.
  void check() const;

 private:
  scenarios::RunSpec read(const std::vector<std::string>& values, std::uint64_t seed) const;

  RunInput run_;
  std::vector<campaigns::Factor> factors_;
  std::unique_ptr<campaigns::Design> design_;
};

}  // namespace rollrig
