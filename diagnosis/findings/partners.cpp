#include "diagnosis/findings/partners.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {
namespace {

bool holds_all(const Hypothesis& larger, const Hypothesis& smaller) {
  return std::all_of(smaller.terms.begin(), smaller.terms.end(),
                     [&](const SignedTerm& one) { return larger.contains(*one.term); });
}

/// Terms screened on top of the lead; anew where that was not done.
std::vector<Screened> screen_on_top(const Study& study, const Comparison& comparison, const Candidate& lead) {
  for (const ScreenedOnTop& known : comparison.on_top) {
    if (known.hypothesis == lead.fit.hypothesis) return known.screened;
  }
  std::vector<const Term*> others;
  for (const Term* term : study.settings.terms) {
    if (!lead.fit.hypothesis.contains(*term)) others.push_back(term);
  }
  return screen(study, lead, others);
}

/// Of each term its Bayes factor on top of the lead: the mean of both signs where it may have both, and of the two
/// sides of one prior that of the side with the better score.
std::map<std::string, double> find_bayes_factors(const std::vector<Screened>& screened) {
  std::map<std::string, double> factors;
  std::map<std::string, double> best_score;
  for (const Screened& one : screened) {
    if (one.term.term->is_unknown()) continue;
    const models::EffectParameter& size = one.term.term->parameters().front();
    const std::string& name = one.term.term->name();
    const double factor = calc_bayes_factor(one);
    if (size.prior.either_sign) {
      factors[name] += factor / static_cast<double>(possible_signs(size).size());
    } else if (best_score.count(name) == 0 || one.score > best_score[name]) {
      factors[name] = factor;
      best_score[name] = one.score;
    }
  }
  return factors;
}

}  // namespace

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

void find_partners(const Study& study, const Comparison& comparison, const Candidate& lead, rollrig::Cause& cause) {
  const std::size_t terms = lead.fit.hypothesis.terms.size();
  std::map<std::string, double> with;  // weight of each further term, fitted or not
  double larger = 0.0;                 // of two or more further terms
  for (const Candidate& candidate : comparison.candidates) {
    const Hypothesis& hypothesis = candidate.fit.hypothesis;
    if (hypothesis.terms.size() <= terms || !holds_all(hypothesis, lead.fit.hypothesis)) continue;
    if (hypothesis.terms.size() > terms + 1) {
      larger += candidate.probability;
      continue;
    }
    for (const SignedTerm& one : hypothesis.terms) {
      if (lead.fit.hypothesis.contains(*one.term)) continue;
      with[one.term->name()] += candidate.probability;
    }
  }
  double unseen = 0.0;
  if (terms < kMostTerms) {
    const double odds = find_prior(study.settings, terms + 1) / find_prior(study.settings, terms);
    const std::map<std::string, double> fitted = with;
    for (const auto& [term, factor] : find_bayes_factors(screen_on_top(study, comparison, lead))) {
      if (fitted.count(term) > 0) continue;
      with[term] = lead.probability * odds * factor;
      unseen += with[term];
    }
  }
  double acts = lead.probability + larger;
  for (const auto& [term, weight] : with) acts += weight;
  const double all = 1.0 + unseen;  // the hypotheses that were fitted, and these
  cause.acts = acts / all;
  cause.alone = lead.probability / all;
  for (const auto& [term, weight] : with) {
    if (weight / all >= thresholds::kWorthPartner) cause.partners.push_back({term, weight / all});
  }
  std::stable_sort(cause.partners.begin(), cause.partners.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
}

}  // namespace rollrig::diagnosis
