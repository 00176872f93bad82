#pragma once
/// A validation set: cases in an order that tells nothing, with one truth file.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "validation/generator/measurement_set.h"

namespace rollrig::generator {

/// Called after each piece of work.
using Progress = std::function<void(double share_done)>;

/// Makes `count` items. `make` gives the item of a number; it may be called for several at a time, in any order. `take`
/// gets each item that is made, one at a time.
using MakeItems = std::function<void(std::size_t count, const std::function<Json(std::size_t)>& make,
                                     const std::function<void(const Json&)>& take)>;

/// A campaign that a case may have.
struct CampaignChoice {
  const char* name;  // "" where all cases are of one kind
  const Machine* machine = all_machines().front();
  int runs = kMostRuns;       // at most
  const char* run_kind = "";  // of all its runs; empty: as the laboratory has them
};

constexpr const char* kMixed = "mixed";
std::vector<CampaignChoice> mixed_campaigns();

struct ValidationSetOrder {
  std::uint64_t seed = 1;
  std::string kind = kMixed;              // or of a machine
  std::vector<CampaignChoice> campaigns;  // among which that of each case is drawn
  int each = 0;                           // cases of each effect
  int singles = 200;                      // cases of one effect, in turn, sizes small, middle and large in turn
  int none = 40;                          // cases without effect
  int pairs = 30;                         // cases of two effects, drawn among them
  int triples = 0;                        // cases of three effects, drawn among them
  int outside = 30;                       // cases with an effect outside of the catalog, each as often as the others
  OutsideList outside_list = OutsideList::kFirst;  // from which these are drawn
  std::vector<std::string> effects;                // among which
  int runs = kMostRuns;
  bool counterfactual = false;  // also counterfactual/<number>, to be kept from who diagnoses like the truth
  std::string out;
};

/// Effects of the catalog that sets of these campaigns have.
std::vector<std::string> drawn_effects(const std::vector<CampaignChoice>& campaigns);
/// Effects of a list outside of the catalog that sets of these campaigns have.
std::vector<std::string> drawn_outside_effects(const std::vector<CampaignChoice>& campaigns, OutsideList list);

/// The cases of an order; each is a function of the seed and its place.
std::vector<SetOrder> draw_cases(const ValidationSetOrder& order);

/// Writes <out>/sets/<number>/, <out>/truth.json and <out>/truth.sha256, which sha256sum -c reads. `hashed` is told the
/// SHA-256 of truth.json before any of it stands at its place.
void write_validation_set(const ValidationSetOrder& order, const MakeItems& make_items,
                          const std::function<void(const std::string&)>& hashed);
/// Adds truth.json and truth.sha256 to the folder, tells `hashed`, and puts the folder at its place.
void commit_with_truth(OutputFolder& folder, const Json& truth, const std::function<void(const std::string&)>& hashed);

/// The order that makes a case of `truth` anew.
/// Errors  InputError: no truth of this generator
SetOrder read_order(const Json& truth);

/// Errors  InputError: the files in `folder` are not those that the order makes
void require_same_files(const std::string& folder, const SetOrder& order);

}  // namespace rollrig::generator
