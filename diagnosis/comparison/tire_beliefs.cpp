#include "diagnosis/comparison/tire_beliefs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/base_moves.h"

namespace rollrig::diagnosis {
namespace {

/// The largest move of a number with an assumed uncertainty.
double find_largest_assumed_move(const Study& study, const Fit& fit) {
  const Eigen::VectorXd moves = calc_base_moves(study, fit);
  double largest = 0.0;
  for (std::size_t i = 0; i < study.base.size(); ++i) {
    const bool is_of_tire = study.base[i].key.rfind("tire.", 0) == 0;
    if (!is_of_tire || study.sd_sources.at(study.base[i].key) == rollrig::SdSource::kFile) continue;
    largest = std::max(largest, std::abs(moves[to_index(i)]));
  }
  return largest;
}

bool is_strained(const Study& study, const Comparison& comparison) {
  double largest = find_largest_assumed_move(study, study.null.fit);
  if (!comparison.candidates.empty() && std::isfinite(comparison.candidates.front().fit.cost)) {
    largest = std::max(largest, find_largest_assumed_move(study, comparison.candidates.front().fit));
  }
  return largest > thresholds::kStrained_sd;
}

/// Shows the second comparison as further steps where the first one ended.
std::shared_ptr<Stages> make_further_stages(const Stages& first) {
  auto stages = std::make_shared<Stages>();
  if (first.report) {
    stages->report = [report = first.report, done = first.to](double, const std::string& stage) {
      report(done, fmt::format("class values of the tire: {}", stage));
    };
  }
  return stages;
}

Belief compare(const measurements::MeasurementSet& measured, const StudySettings& settings) {
  Belief belief{std::make_unique<Study>(measured, settings), {}};
  belief.comparison = compare_models(*belief.study);
  return belief;
}

/// Probability that a cause or what it cannot be told from acts, alone or with others.
double sum_of_cause(const Comparison& comparison, const rollrig::Cause& cause) {
  std::vector<std::string> named = cause.effects;
  named.insert(named.end(), cause.indistinguishable_from.begin(), cause.indistinguishable_from.end());
  double sum = 0.0;
  const auto add = [&](const std::vector<std::string>& names, double probability) {
    if (contains_all(named, names) || contains_all(names, cause.effects)) sum += probability;
  };
  for (const Candidate& candidate : comparison.candidates) add(candidate.fit.hypothesis.names(), candidate.probability);
  for (const Unfitted& unfitted : comparison.unfitted) add(unfitted.names, unfitted.probability);
  return sum;
}

}  // namespace

Beliefs compare_beliefs(const measurements::MeasurementSet& measured, const StudySettings& settings) {
  Beliefs beliefs{compare(measured, settings), 1.0, std::nullopt};
  const Belief& identified = beliefs.likelier;
  const bool is_open = is_tire_origin_open(measured) && is_strained(*identified.study, identified.comparison);
  if (!is_open) return beliefs;
  StudySettings wide = settings;
  wide.belief = TireBelief::kClass;
  wide.stages = make_further_stages(*settings.stages);
  Belief of_class = compare(measured, wide);
  of_class.study->settings.stages = settings.stages;
  const double log_odds = of_class.comparison.log_evidence - identified.comparison.log_evidence +
                          std::log(thresholds::kClassTirePrior / (1.0 - thresholds::kClassTirePrior));
  const double class_weight = 1.0 / (1.0 + std::exp(-log_odds));
  if (class_weight > 0.5) std::swap(beliefs.likelier, of_class);
  beliefs.weight = std::max(class_weight, 1.0 - class_weight);
  beliefs.other = std::move(of_class);
  return beliefs;
}

double average_of(const Beliefs& beliefs, const std::function<double(const Belief&)>& find) {
  const double likelier = find(beliefs.likelier);
  if (!beliefs.other.has_value()) return likelier;
  return beliefs.weight * likelier + (1.0 - beliefs.weight) * find(*beliefs.other);
}

void average_over_beliefs(const Beliefs& beliefs, std::map<std::string, double>& probability,
                          std::vector<rollrig::Cause>& causes) {
  if (!beliefs.other.has_value()) return;
  const Belief& other = *beliefs.other;
  const auto average = [&](double own, double others) {
    return beliefs.weight * own + (1.0 - beliefs.weight) * others;
  };
  for (auto& [name, value] : probability) {
    double others = 0.0;
    if (name == "none") others = other.study->null.probability;
    if (name == "unknown") others = other.comparison.unknown_probability;
    for (const Candidate& candidate : other.comparison.candidates) {
      const std::vector<std::string> names = candidate.fit.hypothesis.names();
      if (std::count(names.begin(), names.end(), name) > 0) others += candidate.probability;
    }
    for (const Unfitted& unfitted : other.comparison.unfitted) {
      if (unfitted.contains(name)) others += unfitted.probability;
    }
    value = average(value, others);
  }
  for (rollrig::Cause& cause : causes) {
    const double averaged = average(cause.probability, sum_of_cause(other.comparison, cause));
    if (cause.probability > 0.0) scale_probability(averaged / cause.probability, cause);
  }
  sort_after_first(causes);
}

}  // namespace rollrig::diagnosis
