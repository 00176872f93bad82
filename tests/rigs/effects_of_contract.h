#pragma once
/// What the tests of the contract ask of an effect's declaration.

#include <string>
#include <vector>

#include "models/effect.h"
#include "tests/rigs/effect_campaigns.h"

namespace rollrig::tests {

/// Of the quantities, the headings of those that the kind measures.
inline std::vector<std::string> select_measured(const std::vector<Quantity>& quantities, Machine kind) {
  std::vector<std::string> selected;
  for (const Quantity& quantity : quantities) {
    const bool is_force = quantity == models::quantities::kMachineForce;
    const std::string channel = (is_force ? kind->traits.force : quantity).header();
    if (measured_on(kind).count(channel) == 1) selected.push_back(channel);
  }
  return selected;
}

inline std::vector<double> usual_values(const models::EffectInfo& info) {
  std::vector<double> values;
  for (const auto& parameter : info.parameters) values.push_back(parameter.prior.center());
  return values;
}

/// Tire models on which an effect keeps its contract: one alone, or all whose loss follows their temperature.
inline std::vector<std::string> models_for(const models::Effect& effect) {
  if (effect.info.only_against != nullptr) return {effect.info.only_against};
  std::vector<std::string> ids;
  for (const models::TireModel* model : models::all_tire_models()) {
    if (model->info.loss_follows_heat) ids.push_back(model->info.id);
  }
  return ids;
}

}  // namespace rollrig::tests
