#pragma once
/// The diagnoses of a campaign as items, one for each measurement set.

#include <string>
#include <vector>

#include "api/campaign_items.h"
#include "include/rollrig/findings.h"

namespace rollrig {

/// How a campaign of diagnoses diagnoses a set.
DiagnosisOptions make_diagnosis_options(const DiagnosisCampaignInput& input);

class SetItems : public CampaignItems {
 public:
  explicit SetItems(DiagnosisCampaignInput input) : input_(std::move(input)) {}

  std::size_t count() const override { return input_.sets.size(); }
  Json describe(std::size_t item) const override;
  /// As diagnosis::diagnose_member() has it.
  Json carry_out(std::size_t item, std::uint64_t seed) const override;

  std::vector<std::string> list_keys() const override { return {"set", "folder"}; }
  std::vector<std::string> calc_values(std::size_t item) const override;
  /// Reads all sets, and the tires of the assets. A set that cannot be read is warned of.
  Check check() const override;
  /// Nothing: a set that cannot be read is a failure of its item.
  void check_briefly(bool /*has_same_assets*/) const override {}
  /// Nothing: carry_out() asks for the files that it has read. There may be thousands of others.
  void require_unchanged() const override {}
  /// Machine, tire, verdict, cause, its probability, and the gap in noise floors without and with it.
  Json flatten(const Json& result) const override;

 private:
  DiagnosisCampaignInput input_;
};

}  // namespace rollrig
