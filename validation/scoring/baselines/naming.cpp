#include "validation/scoring/baselines/naming.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "validation/scoring/case.h"

namespace rollrig::validation {

std::vector<std::string> find_named(const LinearData& data, const std::vector<std::size_t>& chosen) {
  std::vector<std::string> named;
  for (const std::size_t column : chosen) {
    const std::string& effect = data.effects[column];
    const bool is_new = std::find(named.begin(), named.end(), effect) == named.end();
    if (is_new && named.size() < kLargestNamedSet) named.push_back(effect);
  }
  return named;
}

Naming weigh(const LinearData& data, const std::vector<CandidateModel>& models, std::vector<std::size_t> chosen) {
  Naming naming;
  naming.chosen = std::move(chosen);
  naming.probability = {{"none", 0.0}, {"unknown", 0.0}};
  for (const std::string& effect : data.effects) naming.probability[effect] = 0.0;
  const std::vector<std::string> named = find_named(data, naming.chosen);
  const double best = std::min_element(models.begin(), models.end())->criterion;
  double sum = 0.0;
  for (const CandidateModel& model : models) sum += std::exp(0.5 * (best - model.criterion));
  for (const CandidateModel& model : models) {
    const double weight = std::exp(0.5 * (best - model.criterion)) / sum;
    std::set<std::string> effects;
    for (const std::size_t column : model.columns) effects.insert(data.effects[column]);
    for (const std::string& effect : effects) naming.probability[effect] += weight;
    if (effects.empty()) naming.probability["none"] += weight;
    const bool has_named = std::all_of(named.begin(), named.end(),
                                       [&effects](const std::string& effect) { return effects.count(effect) > 0; });
    if (has_named && (!named.empty() || effects.empty())) naming.named_probability += weight;
  }
  return naming;
}

}  // namespace rollrig::validation
