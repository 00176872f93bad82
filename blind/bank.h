#pragma once
/// A whole bank of sets in an order that tells nothing, with one truth file.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "blind/measurement_set.h"

namespace blind {

struct BankOrder {
  std::uint64_t seed = 1;
  Kind kind = Kind::kDrum;
  int each = 20;                     // sets of each effect
  int none = 100;                    // sets without effect
  int pairs = 0;                     // sets of two effects, drawn among them
  int outside = 0;                   // sets with an effect outside of the catalogue, each as often as the others
  std::vector<std::string> effects;  // among which
  int runs = kMostRuns;
  bool counterfactual = false;  // also counterfactual/<number>, to be sealed like the truth
  std::string out;
};

/// Effects that banks of a kind have: of the catalogue, or outside of it.
std::vector<std::string> drawn_effects(Kind kind, bool outside);

/// Writes <out>/sets/<number>/ and <out>/truth.json. `sealed` is told the SHA-256 of truth.json before any of
/// it stands at its place; `progress` the number of sets done and in all.
void write_bank(const BankOrder& order, const std::function<void(const std::string&)>& sealed,
                const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace blind
