#include "validation/generator/kind_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/generator/bank.h"
#include "validation/generator/effect.h"
#include "validation/generator/measurement_set.h"
#include "validation/generator/problem.h"

namespace blind {

Kind read_kind(const std::string& name) {
  for (std::size_t i = 0; i < kKindNames.size(); ++i) {
    if (name == kKindNames[i]) return static_cast<Kind>(i);
  }
  const std::vector<std::string> known(kKindNames.begin(), kKindNames.end());
  throw InputError({fmt::format("unknown kind '{}'", name), "--kind", name, fmt::format("{}", fmt::join(known, ", ")),
                    find_nearest(name, known)});
}

std::vector<CampaignChoice> read_campaigns(const std::string& name) {
  if (name == kMixed) return {kMixedCampaigns.begin(), kMixedCampaigns.end()};
  for (std::size_t i = 0; i < kKindNames.size(); ++i) {
    if (name == kKindNames[i]) return {{"", static_cast<Kind>(i)}};
  }
  std::vector<std::string> known(kKindNames.begin(), kKindNames.end());
  known.emplace_back(kMixed);
  throw InputError({fmt::format("unknown kind '{}'", name), "--kind", name, fmt::format("{}", fmt::join(known, ", ")),
                    find_nearest(name, known)});
}

std::string list_kinds(Grounds grounds) {
  std::vector<std::string> names;
  if ((grounds & kDrumGround) != 0) names.emplace_back("drum");
  if ((grounds & kDynoGround) != 0) names.emplace_back("dyno");
  if ((grounds & kRoadGround) != 0) names.emplace_back("road (combined)");
  if ((grounds & kConstantGround) != 0) names.emplace_back("road (constant_rrc)");
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void check_grounds(const std::vector<std::string>& ids, Kind kind, bool drawn) {
  for (const std::string& id : ids) {
    if (find_common_grounds({id}, kind, drawn) != kNowhere) continue;
    const EffectKind& effect = *find_effect_kind(id);
    throw InputError({fmt::format("{} has no {} on a {}", id, drawn ? "visible trace" : "place", name_of(kind)),
                      "--kind", name_of(kind), list_kinds(drawn ? effect.drawn : effect.acts), ""});
  }
}

void check_drawn_somewhere(const std::vector<std::string>& ids) {
  for (const std::string& id : ids) {
    if (find_effect_kind(id)->drawn != kNowhere) continue;
    throw InputError({fmt::format("{} has no visible trace on any kind", id), "--effects", id, "other effects", ""});
  }
}

std::optional<bool> read_baseline(const std::string& name, const std::vector<std::string>& ids, Kind kind) {
  if (name.empty()) return std::nullopt;
  if (kind != Kind::kRoad) {
    throw InputError({"rig sets have the combined law", "--baseline", name, "--kind road beside it", ""});
  }
  const std::vector<std::string> known{"combined", "constant_rrc"};
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw InputError({fmt::format("unknown baseline '{}'", name), "--baseline", name, "combined, constant_rrc",
                      find_nearest(name, known)});
  }
  const bool is_constant = name == "constant_rrc";
  const Grounds grounds = find_common_grounds(ids, kind, false);
  if ((grounds & (is_constant ? kConstantGround : kRoadGround)) == 0) {
    throw InputError({"the effect has no place against this law", "--baseline", name, list_kinds(grounds), ""});
  }
  return is_constant;
}

}  // namespace blind
