#include "diagnosis/comparison/unfitted.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {
namespace {

/// Of each named effect its Bayes factor: the mean of both signs where it may have both, and of the two sides of one
/// prior that of the side with the better score.
std::map<std::string, double> find_bayes_factors(const std::vector<Screened>& screened) {
  std::map<std::string, double> factors;
  std::map<std::string, double> best_score;
  for (const Screened& one : screened) {
    if (one.term.term->is_unknown()) continue;
    const models::EffectParameter& size = one.term.term->parameters().front();
    const std::string& name = one.term.term->name();
    const double factor = std::min(calc_bayes_factor(one), std::exp(thresholds::kWorthAdding_nats));
    if (size.prior.either_sign) {
      factors[name] += factor / static_cast<double>(possible_signs(size).size());
    } else if (best_score.count(name) == 0 || one.score > best_score[name]) {
      factors[name] = factor;
      best_score[name] = one.score;
    }
  }
  return factors;
}

/// Probability of what one more effect is added to.
struct Below {
  double probability = 0.0;
  double of_law_error = 0.0;  // part of it (Candidate::of_law_error)
};

/// Of a hypothesis with both signs of its terms.
Below sum_below(const Comparison& comparison, const std::vector<std::string>& names) {
  Below sum;
  for (const Candidate& candidate : comparison.candidates) {
    if (candidate.fit.hypothesis.names() != names) continue;
    sum.probability += candidate.probability;
    sum.of_law_error += candidate.of_law_error;
  }
  return sum;
}

/// Adds those with one effect more than a fitted hypothesis, unless they are `known`. Where an error of the laws made
/// the gain, the further effect has no more than its prior odds.
void add_on_top_of(const std::vector<std::string>& fitted, const Below& below, double odds,
                   const std::vector<Screened>& screened, std::set<std::set<std::string>>& known,
                   std::vector<Unfitted>& all) {
  for (const auto& [name, factor] : find_bayes_factors(screened)) {
    std::vector<std::string> names = fitted;
    names.push_back(name);
    if (!known.insert({names.begin(), names.end()}).second) continue;
    const double exact = below.probability - below.of_law_error;
    all.push_back({std::move(names), odds * (exact * factor + below.of_law_error * std::min(1.0, factor))});
  }
}

}  // namespace

bool Unfitted::contains(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

double calc_bayes_factor(const Screened& screened) {
  if (!screened.was_simulated || !(screened.detectability > 0.0)) return 1.0;
  const models::EffectParameter& size = screened.term.term->parameters().front();
  const double variance = screened.detectability * screened.detectability;
  double mean = 0.0;
  for (const SizePoint& point : list_size_points(size, screened.term.sign, screened.tried_u)) {
    const double x = point.ratio;
    mean += point.weight * std::exp(x * screened.along - 0.5 * x * x * variance);
  }
  return mean;
}

std::vector<Unfitted> list_unfitted(const Study& study, const Comparison& comparison) {
  std::set<std::set<std::string>> known;
  for (const Candidate& candidate : comparison.candidates) {
    const std::vector<std::string> names = candidate.fit.hypothesis.names();
    known.insert({names.begin(), names.end()});
  }
  std::vector<Unfitted> all;
  add_on_top_of({}, {study.null.probability}, find_prior(study.settings, 1) / study.settings.priors.none,
                comparison.screened, known, all);
  for (const ScreenedOnTop& on_top : comparison.on_top) {
    const std::size_t terms = on_top.hypothesis.terms.size();
    if (terms >= kMostTerms) continue;
    const std::vector<std::string> names = on_top.hypothesis.names();
    const double odds = find_prior(study.settings, terms + 1) / find_prior(study.settings, terms);
    add_on_top_of(names, sum_below(comparison, names), odds, on_top.screened, known, all);
  }
  return all;
}

double sum_probability(const std::vector<Unfitted>& unfitted) {
  double sum = 0.0;
  for (const Unfitted& one : unfitted) sum += one.probability;
  return sum;
}

}  // namespace rollrig::diagnosis
