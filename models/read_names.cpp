/// Effects and tire models by the names that files have for them.
#include <algorithm>

#include <fmt/format.h>

#include "models/effect.h"
#include "sim/core/error.h"

namespace rollrig::models {

const TireModel& find_tire_model(const std::string& id) {
  for (const TireModel* model : all_tire_models()) {
    if (model->info.id == id) return *model;
  }
  throw InputError(unknown_name("tire model", id, list_ids(all_tire_models())));
}

const Effect& find_effect(const std::string& id) {
  for (const Effect* effect : all_effects()) {
    if (effect->info.id == id) return *effect;
  }
  throw InputError(unknown_name("effect", id, effect_ids()));
}

std::vector<ActiveEffect> read_effects(const ConfigTable& effects) {
  for (const auto& [id, value] : effects.entries) {
    const std::vector<std::string> ids = effect_ids();
    InputProblem unknown = unknown_name("effect", id, ids);
    unknown.file = value.origin.file;
    unknown.line = value.origin.line;
    unknown.key = fmt::format("[effects.{}]", id);
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) throw InputError(unknown);
  }
  std::vector<ActiveEffect> active;
  TableReader reader(effects, "[effects]");
  for (const Effect* effect : all_effects()) {
    const ConfigTable* table = reader.table(effect->info.id);
    if (table == nullptr) continue;
    TableReader own(*table, fmt::format("[effects.{}]", effect->info.id));
    ActiveEffect on{effect, {}};
    for (const EffectParameter& parameter : effect->info.parameters) {
      on.parameters.push_back(own.number({parameter.key, parameter.range, parameter.doc, parameter.prior.center()}));
    }
    own.finish();
    active.push_back(std::move(on));
  }
  return active;
}

}  // namespace rollrig::models
