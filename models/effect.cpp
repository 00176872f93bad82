#include "models/effect.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rollrig::models {

double Prior::center() const { return scale == Scale::kLog ? std::sqrt(low * high) : 0.5 * (low + high); }

bool is_seen_on(const EffectInfo& info, const MachineTraits& machine) {
  return info.acts_on(machine) && !info.faint_on(machine);
}

bool acts_in(const EffectInfo& info, const MachineTraits& machine, const TireModel& model) {
  for (const auto& [node, name] : model.info.nodes) {
    if (info.nodes[index_of(node)]) return false;
  }
  return info.acts_on(machine) && (info.only_against == nullptr || model.info.id == info.only_against);
}

std::vector<std::string> effect_ids() { return list_ids(all_effects()); }

std::string describe_effects(const std::vector<ActiveEffect>& effects) {
  std::vector<std::string> described;
  for (const ActiveEffect& on : effects) {
    std::vector<std::string> values;
    for (std::size_t i = 0; i < on.parameters.size(); ++i) {
      const std::string& key = on.effect->info.parameters[i].key;
      values.push_back(fmt::format("{} = {:.4g}", key, unit_of_key(key).from_si(on.parameters[i])));
    }
    described.push_back(fmt::format("{} ({})", on.effect->info.id, fmt::join(values, ", ")));
  }
  return fmt::format("{}", fmt::join(described, ", "));
}

}  // namespace rollrig::models
