#include "diagnosis/findings/undetected.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {
namespace {

/// The clearest trial of a term on top of the null; nullptr where none changes anything.
const Screened* find_clearest_trial(const Comparison& comparison, const SignedTerm& term) {
  const Screened* clearest = nullptr;
  for (const Screened& one : comparison.screened) {
    if (!(one.term == term) || !(one.detectability > 0.0)) continue;
    if (clearest == nullptr || one.detectability > clearest->detectability) clearest = &one;
  }
  return clearest;
}

/// Probability that the set would not show the size of a term that acts, by what the set says of that size.
double calc_hidden(const Screened& clearest) {
  const models::EffectParameter& size = clearest.term.term->parameters().front();
  const double variance = clearest.detectability * clearest.detectability;
  const double best = variance > 0.0 ? 0.5 * clearest.along * clearest.along / variance : 0.0;  // of any size
  double hidden = 0.0;
  double sum = 0.0;
  for (const SizePoint& point : list_size_points(size, clearest.term.sign, clearest.tried_u)) {
    const double x = point.ratio;
    const double weight = point.weight * std::exp(x * clearest.along - 0.5 * x * x * variance - best);
    sum += weight;
    if (std::abs(x) * clearest.detectability < thresholds::kDetectableEffect_sd) hidden += weight;
  }
  return sum > 0.0 ? hidden / sum : 0.0;
}

/// Probability that the set would not show a hypothesis that was not fitted: the mean of both signs of each effect, and
/// of those the least.
double calc_hidden(const Comparison& comparison, const Unfitted& unfitted) {
  std::map<std::string, std::map<int, double>> by_effect;
  for (const Screened& one : comparison.screened) {
    const std::string& name = one.term.term->name();
    if (!unfitted.contains(name)) continue;
    const Screened* clearest = find_clearest_trial(comparison, one.term);
    by_effect[name][one.term.sign] = clearest == nullptr ? 1.0 : calc_hidden(*clearest);
  }
  double hidden = 1.0;
  for (const auto& [name, by_sign] : by_effect) {
    double sum = 0.0;
    for (const auto& [sign, of_sign] : by_sign) sum += of_sign;
    hidden = std::min(hidden, sum / static_cast<double>(by_sign.size()));
  }
  return hidden;
}

/// Probability that the set would show no term of a hypothesis.
double calc_hidden(const Comparison& comparison, const Hypothesis& hypothesis) {
  double hidden = 1.0;
  for (const SignedTerm& one : hypothesis.terms) {
    const Screened* clearest = find_clearest_trial(comparison, one);
    if (clearest != nullptr) hidden = std::min(hidden, calc_hidden(*clearest));
  }
  return hidden;
}

}  // namespace

double calc_nothing_detectable(const Study& study, const Comparison& comparison) {
  double sum = study.null.probability;
  for (const Candidate& candidate : comparison.candidates) {
    sum += candidate.probability * calc_hidden(comparison, candidate.fit.hypothesis);
  }
  for (const Unfitted& one : comparison.unfitted) sum += one.probability * calc_hidden(comparison, one);
  return std::min(1.0, sum);
}

}  // namespace rollrig::diagnosis
