#pragma once
/// A whole bank of sets in an order that tells nothing, with one truth file.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/generator/measurement_set.h"

namespace blind {

struct BankOrder {
  std::uint64_t seed = 1;
  std::string kind = name_of(Kind::kDrum);                   // or kMixed
  std::vector<CampaignChoice> campaigns{{"", Kind::kDrum}};  // among which that of each set is drawn
  int each = 20;                                             // sets of each effect
  int singles = 0;                   // sets of one effect, in turn, sizes small, middle and large in turn
  int none = 100;                    // sets without effect
  int pairs = 0;                     // sets of two effects, drawn among them
  int outside = 0;                   // sets with an effect outside of the catalog, each as often as the others
  std::vector<std::string> effects;  // among which
  int runs = kMostRuns;
  bool counterfactual = false;  // also counterfactual/<number>, to be sealed like the truth
  std::string out;
};

constexpr const char* kMixed = "mixed";

/// Effects that banks of these campaigns have: of the catalog, or outside of it.
std::vector<std::string> drawn_effects(const std::vector<CampaignChoice>& campaigns, bool outside);

/// Those of `campaigns` in which banks have all of `effects` together.
std::vector<CampaignChoice> find_campaigns(const std::vector<CampaignChoice>& campaigns,
                                           const std::vector<std::string>& effects);

/// Writes <out>/sets/<number>/, <out>/truth.json and <out>/seal.sha256, which sha256sum -c reads. `sealed` is told the
/// SHA-256 of truth.json before any of it stands at its place; `progress` the number of sets done and in all.
void write_bank(const BankOrder& order, const std::function<void(const std::string&)>& sealed,
                const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace blind
