#include "diagnosis/pair/find_difference.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/findings/lead.h"
#include "diagnosis/findings/verdict.h"
#include "diagnosis/terms/machine_terms.h"

namespace rollrig::diagnosis {
namespace {

constexpr const char* kCurvature = "curvature_exponent";

const MachineTerm* find_machine_term(const std::string& name) {
  const auto& all = all_machine_terms();
  const auto of_name = std::find_if(all.begin(), all.end(), [&](const Term* term) { return term->name() == name; });
  return of_name == all.end() ? nullptr : *of_name;
}

bool has_different_drums(const Study& study) {
  constexpr double kSame = 0.01;
  const double first_per_m = study.set.context(0).surface_curvature_per_m;
  const double second_per_m = study.set.context(1).surface_curvature_per_m;
  return std::abs(first_per_m - second_per_m) > kSame * std::max(first_per_m, second_per_m);
}

/// Hypotheses that differ in the same effects.
struct DifferingGroup {
  std::vector<std::string> effects;
  double probability = 0.0;
  const Candidate* likeliest = nullptr;
};

std::vector<DifferingGroup> group_by_difference(const Study& study, const Comparison& comparison) {
  std::map<std::vector<std::string>, DifferingGroup> groups;
  for (const Candidate& candidate : comparison.candidates) {
    const std::vector<std::string> effects = list_differing(study, candidate.fit.hypothesis.names());
    if (effects.empty() || !std::isfinite(candidate.fit.cost)) continue;
    DifferingGroup& group = groups[effects];
    group.effects = effects;
    group.probability += candidate.probability;
    const bool is_better = group.likeliest == nullptr || candidate.posterior() > group.likeliest->posterior();
    if (is_better) group.likeliest = &candidate;
  }
  std::vector<DifferingGroup> sorted;
  for (auto& [effects, group] : groups) sorted.push_back(std::move(group));
  std::stable_sort(sorted.begin(), sorted.end(), [](const DifferingGroup& a, const DifferingGroup& b) {
    return a.likeliest->posterior() > b.likeliest->posterior();
  });
  return sorted;
}

/// Calls visit(names of the terms, probability) for every hypothesis without a free discrepancy but the baseline.
template <class Visit>
void visit_hypotheses(const Comparison& comparison, Visit&& visit) {
  for (const Candidate& one : comparison.candidates) visit(one.fit.hypothesis.names(), one.probability);
  for (const Unfitted& one : comparison.unfitted) visit(one.names, one.probability);
}

std::vector<rollrig::OnMachine> list_on_machine(const Comparison& comparison, const std::vector<std::string>& effects) {
  std::vector<rollrig::OnMachine> all;
  for (const std::string& effect : effects) {
    rollrig::OnMachine on{effect, {}};
    visit_hypotheses(comparison, [&](const std::vector<std::string>& names, double probability) {
      for (const std::string& name : names) {
        const MachineTerm* term = find_machine_term(name);
        if (term != nullptr && term->effect_name() == effect) on.probability[term->machine()] += probability;
      }
    });
    all.push_back(std::move(on));
  }
  return all;
}

/// That the machines differ in these effects, or in others that are named beside them.
double sum_of_difference(const Study& study, const Comparison& comparison, const rollrig::MachineDifference& cause) {
  std::vector<std::string> named = cause.effects;
  named.insert(named.end(), cause.indistinguishable_from.begin(), cause.indistinguishable_from.end());
  double sum = 0.0;
  visit_hypotheses(comparison, [&](const std::vector<std::string>& names, double probability) {
    const std::vector<std::string> effects = list_differing(study, names);
    if (effects.empty()) return;
    if (contains_all(named, effects) || contains_all(effects, cause.effects)) sum += probability;
  });
  return sum;
}

}  // namespace

std::vector<std::string> list_differing(const Study& study, const std::vector<std::string>& terms) {
  std::set<std::string> effects;
  for (const std::string& name : terms) {
    if (const MachineTerm* term = find_machine_term(name)) effects.insert(term->effect_name());
    if (name == kCurvature && has_different_drums(study)) effects.insert(name);
  }
  return {effects.begin(), effects.end()};
}

std::map<std::string, double> find_pair_probabilities(const Study& study, const Comparison& comparison) {
  std::map<std::string, double> probability{{"agree", study.null.probability},
                                            {"unknown", comparison.unknown_probability}};
  for (const Term* term : study.settings.terms) {
    for (const std::string& effect : list_differing(study, {term->name()})) probability[effect] += 0.0;
  }
  visit_hypotheses(comparison, [&](const std::vector<std::string>& names, double of_hypothesis) {
    const std::vector<std::string> effects = list_differing(study, names);
    if (effects.empty()) probability["agree"] += of_hypothesis;
    for (const std::string& effect : effects) probability[effect] += of_hypothesis;
  });
  return probability;
}

std::vector<NamedDifference> find_differences(const Study& study, const Comparison& comparison) {
  const std::vector<DifferingGroup> groups = group_by_difference(study, comparison);
  std::set<std::vector<std::string>> taken;
  std::vector<NamedDifference> causes;
  for (const DifferingGroup& group : groups) {
    if (taken.count(group.effects) > 0) continue;
    const Candidate& lead = *group.likeliest;
    if (!causes.empty() && lead.posterior() < thresholds::kWorthNaming) break;
    std::map<std::string, double> beside;
    for (const DifferingGroup& other : groups) {
      if (taken.count(other.effects) > 0 || other.effects.size() > group.effects.size()) continue;
      if (is_told_apart(study, lead, *other.likeliest)) continue;
      taken.insert(other.effects);
      if (!is_open_beside(lead, *other.likeliest)) continue;
      for (const std::string& effect : other.effects) beside[effect] += other.likeliest->posterior();
    }
    rollrig::MachineDifference cause;
    cause.effects = group.effects;
    cause.indistinguishable_from = find_named_beside(cause.effects, lead.posterior(), std::move(beside));
    cause.probability = sum_of_difference(study, comparison, cause);
    std::vector<std::string> named = cause.effects;
    named.insert(named.end(), cause.indistinguishable_from.begin(), cause.indistinguishable_from.end());
    cause.on_machine = list_on_machine(comparison, named);
    cause.parameters = estimate_parameters(study, lead);
    causes.push_back({std::move(cause), &lead});
  }
  std::stable_sort(causes.begin(), causes.end(), [](const NamedDifference& a, const NamedDifference& b) {
    return a.cause.probability > b.cause.probability;
  });
  return causes;
}

rollrig::PairVerdict find_pair_verdict(const std::map<std::string, double>& probability,
                                       const std::vector<NamedDifference>& causes) {
  const double agree = probability.at("agree");
  const double unknown = probability.at("unknown");
  const double named = causes.empty() ? 0.0 : causes.front().cause.probability;
  const bool is_long =
      !causes.empty() &&
      causes.front().cause.effects.size() + causes.front().cause.indistinguishable_from.size() > thresholds::kLongSet;
  const bool beats_each =
      std::all_of(probability.begin(), probability.end(), [agree](const auto& one) { return agree >= one.second; });
  if (agree >= unknown && (agree >= named || (is_long && beats_each))) return rollrig::PairVerdict::kAgree;
  return unknown >= named ? rollrig::PairVerdict::kUnexplained : rollrig::PairVerdict::kExplained;
}

}  // namespace rollrig::diagnosis
