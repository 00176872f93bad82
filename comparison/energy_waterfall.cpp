#include "comparison/energy_waterfall.h"

#include <string>
#include <vector>

namespace rollrig::comparison {
namespace {

/// Terms of the heat balance of the tire, which has a ledger of its own (rigs/drum_channels.cpp).
bool is_thermal(const std::string& term) { return term.rfind("heat_", 0) == 0 || term == "stored_heat"; }

double find_term_J(const Json& terms_J, const std::string& name) {
  const auto found = terms_J.find(name);
  return found != terms_J.end() && found->is_number() ? found->get<double>() : 0.0;
}

/// Mechanical terms of either, in the order of the reference.
std::vector<std::string> list_terms(const Json& reference_J, const Json& other_J) {
  std::vector<std::string> names;
  for (const auto& [name, value] : reference_J.items()) {
    if (!is_thermal(name)) names.push_back(name);
  }
  for (const auto& [name, value] : other_J.items()) {
    if (!is_thermal(name) && !reference_J.contains(name)) names.push_back(name);
  }
  return names;
}

}  // namespace

std::optional<EnergyWaterfall> make_waterfall(const Json& reference_terms_J, const Json& other_terms_J,
                                              const std::string& compared) {
  const std::vector<std::string> names = list_terms(reference_terms_J, other_terms_J);
  EnergyWaterfall waterfall;
  waterfall.compared = compared;
  for (const std::string& name : names) {
    const double in_J = find_term_J(reference_terms_J, name);
    if (in_J <= waterfall.start_J) continue;
    waterfall.term = name;
    waterfall.start_J = in_J;
  }
  if (waterfall.term.empty()) return std::nullopt;
  waterfall.end_J = find_term_J(other_terms_J, waterfall.term);
  double left_J = waterfall.end_J - waterfall.start_J;
  for (const std::string& name : names) {
    if (!reference_terms_J.contains(name) || !other_terms_J.contains(name)) waterfall.missing.push_back(name);
    if (name == waterfall.term) continue;
    const double step_J = find_term_J(reference_terms_J, name) - find_term_J(other_terms_J, name);
    if (step_J == 0.0) continue;
    waterfall.steps.push_back({name, step_J});
    left_J -= step_J;
  }
  if (left_J != 0.0) waterfall.steps.push_back({"not closed", left_J});
  return waterfall;
}

}  // namespace rollrig::comparison
