#pragma once
/// One measurement set with its hidden cause.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>
#include "sim/core/json.h"

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {

/// What is wanted.
struct SetOrder {
  std::vector<std::string> effects;          // none: the baseline
  std::vector<std::optional<double>> sizes;  // one an effect; none: drawn
  std::uint64_t seed = 1;
  std::size_t common_effects = 0;               // of the first so many the shape is drawn by `tire_seed`
  std::optional<std::uint64_t> tire_seed = {};  // of the tire, and of what is done with it; none: `seed`
  std::vector<std::string> forms;               // one an effect; none: drawn
  std::vector<SizeClass> size_classes;          // one an effect; none: sizes from all that are drawn
  const Machine* machine = all_machines().front();
  std::string run_kind;              // of all runs; empty: as the laboratory has them
  std::optional<bool> constant_rrc;  // of a road set; none: drawn among what the effects allow
  int runs = kMostRuns;
  bool noise_free = false;
  bool nominal_base = false;
  std::string name = "campaign";
  std::string campaign;  // name of the CampaignChoice that was drawn; empty where all cases are of one kind
};

using Files = std::map<std::string, std::string>;  // contents by name

struct MadeSet {
  Files files;
  Files counterfactual;  // the same without effect and without noise
  Json truth;
};

/// Laws against which a set may be judged.
struct Laws {
  bool combined = false;
  bool constant_rrc = false;

  bool any() const { return combined || constant_rrc; }
};

/// Against which all of `effects` are to be found together on a machine; with `drawn`, as validation sets have them.
Laws find_common_laws(const std::vector<std::string>& effects, const Machine& machine, bool drawn);

/// What is drawn of a set: its truth but for signal_floors and campaign_kind, which make_set() adds.
Json draw_truth(const SetOrder& order);

/// Makes a set. Its files are a function of the order and nothing else.
MadeSet make_set(const SetOrder& order, bool with_counterfactual);

/// The files of the same set with further runs after its own: same specimen, effects, sensors. Streams of random
/// numbers go by session and run, so that its own runs are the same to the bit.
Files follow_up(const SetOrder& order, std::vector<RunPlan> further);

}  // namespace rollrig::generator
