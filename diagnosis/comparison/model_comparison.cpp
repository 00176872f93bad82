#include "diagnosis/comparison/model_comparison.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnosis/comparison/evaluator.h"
#include "diagnosis/comparison/evidence.h"

namespace rollrig::diagnosis {
namespace {

/// Screened effects worth a refit: within `nats` of the best, the best `least` at least, and those of which screening
/// could not say anything.
std::vector<Screened> choose(std::vector<Screened> screened, std::size_t least, double nats) {
  std::stable_sort(screened.begin(), screened.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<Screened> chosen;
  for (const Screened& one : screened) {
    const bool is_near = chosen.size() < least || one.score > screened.front().score - nats;
    if (is_near || !one.was_simulated) chosen.push_back(one);
  }
  return chosen;
}

/// Named effects, and families of unknown ones: they do not compete for refits.
std::pair<std::vector<Screened>, std::vector<Screened>> part_unknown(const std::vector<Screened>& screened) {
  std::pair<std::vector<Screened>, std::vector<Screened>> parts;
  for (const Screened& one : screened) (one.term.term->is_unknown() ? parts.second : parts.first).push_back(one);
  return parts;
}

/// Adds candidates; of one hypothesis found from two starts the better stays.
void add_candidates(std::vector<Candidate> more, std::vector<Candidate>& all) {
  for (Candidate& one : more) {
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const auto& other) { return one.fit.hypothesis == other.fit.hypothesis; });
    if (known == all.end()) {
      all.push_back(std::move(one));
    } else if (one.log_evidence > known->log_evidence) {
      *known = std::move(one);
    }
  }
}

/// Of the two signs of one size, both halves of its prior.
double sign_share(const Hypothesis& hypothesis) {
  double share = 1.0;
  for (const SignedTerm& one : hypothesis.terms) {
    share /= static_cast<double>(possible_signs(one.term->parameters().front()).size());
  }
  return share;
}

void assign_probabilities(Study& study, Comparison& comparison) {
  const ComparisonPriors& priors = study.settings.priors;
  std::vector<double> logs{std::log(priors.none) + study.null.log_evidence,
                           std::log(priors.unknown) + study.null.log_discrepancy};
  for (const Candidate& candidate : comparison.candidates) {
    const double share = sign_share(candidate.fit.hypothesis);
    const double prior = find_prior(study.settings, candidate.fit.hypothesis);
    logs.push_back(std::log(share * prior) + candidate.log_evidence);
    const double look_alike = prior * priors.look_alike / priors.singles;
    logs.push_back(std::log(share * look_alike) + candidate.log_discrepancy);
  }
  const double total = comparison.log_evidence = log_sum_exp(logs);
  study.null.probability = std::exp(logs[0] - total);
  study.null.discrepancy_probability = comparison.unknown_probability = std::exp(logs[1] - total);
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
    comparison.candidates[i].probability = std::exp(logs[2 + 2 * i] - total);
    comparison.candidates[i].discrepancy_probability = std::exp(logs[3 + 2 * i] - total);
    Candidate& candidate = comparison.candidates[i];
    if (candidate.fit.hypothesis.has_unknown()) {
      candidate.discrepancy_probability += std::exchange(candidate.probability, 0.0);
    }
    comparison.unknown_probability += candidate.discrepancy_probability;
  }
  std::stable_sort(comparison.candidates.begin(), comparison.candidates.end(),
                   [](const auto& a, const auto& b) { return a.log_evidence > b.log_evidence; });
}

/// Whether a family of unknown effects changes so little beside a named effect that it may be an error of that effect's
/// law: less than a distorted look-alike would (ModelError::look_alike_share).
bool is_distortion(const Study& study, const Candidate& named, const Candidate& with_unknown) {
  if (!with_unknown.fit.hypothesis.has_unknown() || !std::isfinite(with_unknown.fit.cost)) return false;
  const double of_named = sum_squared_floors(study.set, named.fit.simulated - study.null.fit.simulated);
  const double of_unknown = sum_squared_floors(study.set, with_unknown.fit.simulated - named.fit.simulated);
  const double share = study.settings.model_error.look_alike_share;
  return of_unknown < share * share * of_named;
}

/// On top of the best `firsts` hypotheses of so many terms the `seconds` terms that gain most: those whose score
/// could make up for the smaller prior.
struct Addition {
  std::size_t terms;
  std::size_t firsts;
  std::size_t seconds;
  const char* stage;
  double until;  // share of the diagnosis that is done at the end of the stage
};

void add_on_top(const Study& study, const Evaluator& evaluator, const Addition& how, Comparison& comparison) {
  std::vector<Candidate> lower;
  for (const Candidate& candidate : comparison.candidates) {
    const Hypothesis& hypothesis = candidate.fit.hypothesis;
    const bool is_first = hypothesis.terms.size() == how.terms && !hypothesis.has_unknown();
    if (is_first && lower.size() < how.firsts) lower.push_back(candidate);
  }
  Stages& stages = *study.settings.stages;
  const double step = (how.until - stages.to) / static_cast<double>(std::max<std::size_t>(1, lower.size()));
  for (const Candidate& first : lower) {
    stages.begin(how.stage, stages.to + step);
    if (!(first.log_evidence >= study.null.log_evidence)) continue;  // nor where it could not be fitted
    std::vector<const Term*> others;
    for (const Term* term : study.settings.terms) {
      if (!first.fit.hypothesis.contains(*term)) others.push_back(term);
    }
    if (how.terms == 1) {  // beside several named effects an unknown one could be anything
      others.insert(others.end(), study.settings.unknown_terms.begin(), study.settings.unknown_terms.end());
    }
    std::vector<Screened> screened = screen(study, first, others);
    comparison.on_top.push_back({first.fit.hypothesis, screened});
    screened.erase(std::remove_if(screened.begin(), screened.end(),
                                  [](const Screened& one) { return one.score < thresholds::kWorthAdding_nats; }),
                   screened.end());
    if (screened.empty()) continue;
    const auto [named, unknown] = part_unknown(screened);
    std::vector<Screened> chosen = choose(named, how.seconds, 0.0);
    for (Screened& one : choose(unknown, 1, 0.0)) chosen.push_back(std::move(one));
    std::vector<Candidate> refitted = evaluator.refit_all(first, chosen);
    refitted.erase(std::remove_if(refitted.begin(), refitted.end(),
                                  [&](const Candidate& one) { return is_distortion(study, first, one); }),
                   refitted.end());
    add_candidates(std::move(refitted), comparison.candidates);
  }
}

/// The likeliest hypothesis with effects, alone or with a discrepancy; nullptr where none was fitted.
const Candidate* find_likeliest(const Comparison& comparison) {
  const auto likeliest =
      std::max_element(comparison.candidates.begin(), comparison.candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.posterior() < b.posterior(); });
  return likeliest == comparison.candidates.end() ? nullptr : &*likeliest;
}

/// Whether the likeliest hypothesis is one of so many terms.
bool asks_for(const Comparison& comparison, std::size_t terms) {
  const Candidate* likeliest = find_likeliest(comparison);
  return likeliest != nullptr && likeliest->fit.hypothesis.terms.size() == terms &&
         !likeliest->fit.hypothesis.has_unknown();
}

/// Screens on top of the likeliest hypothesis where that was not done, so that what may act beside it is known.
void screen_on_top_of_likeliest(const Study& study, Comparison& comparison) {
  const Candidate* likeliest = find_likeliest(comparison);
  if (likeliest == nullptr || !std::isfinite(likeliest->fit.cost)) return;
  const Hypothesis& hypothesis = likeliest->fit.hypothesis;
  const bool is_known = std::any_of(comparison.on_top.begin(), comparison.on_top.end(),
                                    [&](const ScreenedOnTop& one) { return one.hypothesis == hypothesis; });
  if (is_known || hypothesis.has_unknown() || hypothesis.terms.size() >= kMostTerms) return;
  std::vector<const Term*> others;
  for (const Term* term : study.settings.terms) {
    if (!hypothesis.contains(*term)) others.push_back(term);
  }
  comparison.on_top.push_back({hypothesis, screen(study, *likeliest, others)});
}

/// The likeliest fit of the hypothesis with these effects; nullptr where there is none.
Candidate* find_likeliest_fit(Comparison& comparison, const std::vector<std::string>& names) {
  Candidate* best = nullptr;
  for (Candidate& one : comparison.candidates) {
    if (one.fit.hypothesis.names() != names) continue;
    if (best == nullptr || one.log_evidence > best->log_evidence) best = &one;
  }
  return best;
}

/// The fitted hypothesis with one effect less that comes nearest to `larger`; nullptr where none was fitted.
Candidate* find_nearest_smaller(Comparison& comparison, const Candidate& larger) {
  const std::vector<std::string> all = larger.fit.hypothesis.names();
  Candidate* nearest = nullptr;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> fewer = all;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    Candidate* one = find_likeliest_fit(comparison, fewer);
    if (one != nullptr && (nearest == nullptr || one->log_evidence > nearest->log_evidence)) nearest = one;
  }
  return nearest;
}

/// What a hypothesis with one effect more gains over `smaller` where the laws of the effects of `smaller` are loose;
/// nothing where that cannot be found.
std::optional<double> calc_gain_beside_loose_laws(const Evaluator& evaluator, const Candidate& larger,
                                                  const Candidate& smaller) {
  std::vector<const Term*> common;
  for (const SignedTerm& one : larger.fit.hypothesis.terms) {
    if (smaller.fit.hypothesis.contains(*one.term)) common.push_back(one.term);
  }
  if (!smaller.log_loose.has_value()) return std::nullopt;
  const std::optional<double> larger_loose = evaluator.weigh_with_loose_laws(larger, common);
  return larger_loose.has_value() ? std::optional(*larger_loose - *smaller.log_loose) : std::nullopt;
}

/// Moves to hypotheses with one effect less what their last effect may be an error of their law.
void weigh_law_errors(const Study& study, const Evaluator& evaluator, Comparison& comparison) {
  for (std::size_t terms = kMostTerms; terms > 1; --terms) {
    for (Candidate& larger : comparison.candidates) {
      if (larger.fit.hypothesis.terms.size() != terms || larger.fit.hypothesis.has_unknown()) continue;
      Candidate* smaller = find_nearest_smaller(comparison, larger);
      if (smaller == nullptr) continue;
      SecondGain gain;
      gain.nats = gain.beside_loose_laws_nats = larger.log_evidence - smaller->log_evidence;
      gain.of_others_nats = smaller->log_evidence - study.null.log_evidence;
      if (larger.probability >= thresholds::kDecides) {
        gain.beside_loose_laws_nats = calc_gain_beside_loose_laws(evaluator, larger, *smaller).value_or(gain.nats);
      }
      const double law_error = calc_law_error(gain);
      const double moved = law_error * larger.probability;
      larger.probability -= moved;
      larger.of_law_error *= 1.0 - law_error;
      smaller->probability += moved;
      smaller->of_law_error += moved;
    }
  }
}

/// Makes room for what was not fitted: all probabilities together are one.
void add_unfitted(Study& study, Comparison& comparison) {
  comparison.unfitted = list_unfitted(study, comparison);
  const double all = 1.0 + sum_probability(comparison.unfitted);
  for (Unfitted& one : comparison.unfitted) one.probability /= all;
  for (Candidate& one : comparison.candidates) {
    one.probability /= all;
    one.of_law_error /= all;
    one.discrepancy_probability /= all;
  }
  study.null.probability /= all;
  study.null.discrepancy_probability /= all;
  comparison.unknown_probability /= all;
  comparison.log_evidence += std::log(all);
}

}  // namespace

double find_prior(const StudySettings& settings, std::size_t terms) {
  const ComparisonPriors& priors = settings.priors;
  const auto n = static_cast<double>(settings.terms.size());
  if (terms == 1) return priors.singles / n;
  if (terms == 2) return priors.pairs / std::max(1.0, n * (n - 1.0) / 2.0);
  return priors.triples / std::max(1.0, n * (n - 1.0) * (n - 2.0) / 6.0);
}

double find_prior(const StudySettings& settings, const Hypothesis& hypothesis) {
  if (!hypothesis.has_unknown()) return find_prior(settings, hypothesis.terms.size());
  const auto families = static_cast<double>(settings.unknown_terms.size());
  if (hypothesis.terms.size() == 1) return settings.priors.families / families;
  return settings.priors.family_beside / families * find_prior(settings, hypothesis.terms.size() - 1);
}

double calc_law_error(const SecondGain& gain) {
  const double in_scale = std::max(0.0, gain.beside_loose_laws_nats) / thresholds::kLawError_nats;
  const double share = std::sqrt(std::max(0.0, gain.nats) / std::max(1.0, gain.of_others_nats));
  const double in_share = share / thresholds::kLawErrorShare;
  const double odds = thresholds::kLawErrorOdds * std::exp(-0.5 * (in_scale * in_scale + in_share * in_share));
  return odds / (1.0 + odds);
}

double Comparison::find_detectability(const Term& term) const {
  double detectability = 0.0;
  for (const Screened& one : screened) {
    if (one.term.term == &term) detectability = std::max(detectability, one.detectability);
  }
  return detectability;
}

Comparison compare_models(Study& study) {
  const Evaluator evaluator(study);
  Stages& stages = *study.settings.stages;
  Comparison comparison;
  stages.begin("baseline", 0.04);
  study.null = evaluator.fit_null();
  stages.begin("screening", 0.1);
  std::vector<const Term*> terms = study.settings.terms;
  terms.insert(terms.end(), study.settings.unknown_terms.begin(), study.settings.unknown_terms.end());
  comparison.screened = screen(study, study.null, terms);
  stages.begin("refit of effects", 0.45);
  const auto [named, unknown] = part_unknown(comparison.screened);
  std::vector<Screened> chosen = choose(named, thresholds::kScreenedLeast, thresholds::kScreened_nats);
  for (Screened& one : choose(unknown, 1, thresholds::kScreened_nats)) chosen.push_back(std::move(one));
  add_candidates(evaluator.refit_all(study.null, chosen), comparison.candidates);
  assign_probabilities(study, comparison);
  add_on_top(study, evaluator, {1, thresholds::kFirstsOfPairs, thresholds::kSecondsOfPairs, "pairs", 0.62}, comparison);
  assign_probabilities(study, comparison);
  if (asks_for(comparison, 2)) {
    add_on_top(study, evaluator, {2, thresholds::kFirstsOfTriples, thresholds::kSecondsOfTriples, "triples", 0.72},
               comparison);
    assign_probabilities(study, comparison);
  }
  weigh_law_errors(study, evaluator, comparison);
  screen_on_top_of_likeliest(study, comparison);
  add_unfitted(study, comparison);
  return comparison;
}

}  // namespace rollrig::diagnosis
