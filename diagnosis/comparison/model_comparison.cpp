#include "diagnosis/comparison/model_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// A free discrepancy: in each channel either as small as model error, or of any size up to a hundred floors.
AmplitudePrior free_amplitude(double smallest) {
  AmplitudePrior prior{{smallest}, {0.5}};
  const double first = std::max(0.4, 4.0 * smallest);
  std::vector<double> larger;
  for (double amplitude = first; amplitude < 100.0; amplitude *= 2.0) larger.push_back(amplitude);
  for (const double amplitude : larger) {
    prior.amplitudes.push_back(amplitude);
    prior.weights.push_back(0.5 / static_cast<double>(larger.size()));
  }
  return prior;
}

/// Rms by channel of a difference of block means, in noise floors.
Amplitudes measure_in_floors(const PreparedSet& set, const Eigen::VectorXd& difference) {
  Amplitudes sums(set.channels().size(), 0.0);
  std::vector<std::size_t> counts(set.channels().size(), 0);
  for (const Series& series : set.series()) {
    const auto rows = difference.segment(at(series.first_residual), at(series.size()));
    sums[series.channel] += rows.squaredNorm() / (series.floor * series.floor);
    counts[series.channel] += series.size();
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    sums[c] = counts[c] > 0 ? std::sqrt(sums[c] / static_cast<double>(counts[c])) : 0.0;
  }
  return sums;
}

/// The shares of model error as far as the loosest of a hypothesis' laws goes.
ModelError loosen(ModelError error, const Hypothesis& hypothesis) {
  for (const ActingEffect& on : hypothesis.effects) {
    const models::LawError& own = on.effect->info.law_error;
    error.law_share = std::max(error.law_share, own.law_share);
    error.whole_share = std::max(error.whole_share, own.whole_share);
  }
  return error;
}

Amplitudes expect_model_error(const ModelError& usual, const Candidate& candidate) {
  const ModelError error = loosen(usual, candidate.fit.hypothesis);
  Amplitudes expected;
  for (std::size_t c = 0; c < candidate.signature.size(); ++c) {
    expected.push_back(std::hypot(error.baseline_floors, error.law_share * candidate.signature[c],
                                  error.whole_share * candidate.whole[c]));
  }
  return expected;
}

/// All that the effects of a fit change, its base parameters held.
Amplitudes measure_whole(const Model& model, const Fit& fit) {
  const Model without(model.set(), model.base(), {});
  Eigen::VectorXd simulated;
  const Eigen::Index own = at(model.own_count());
  if (!without.simulate(fit.unknowns.tail(fit.unknowns.size() - own), 1, simulated, nullptr)) {
    return Amplitudes(model.set().channels().size(), 0.0);
  }
  return measure_in_floors(model.set(), fit.simulated - simulated);
}

/// What all fits of a comparison share.
class Evaluator {
 public:
  Evaluator(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base, const Discrepancy& discrepancy,
            const ComparisonSettings& settings)
      : set_(set),
        base_(base),
        of_time_(discrepancy),
        of_conditions_(discrepancy, Amplitudes(set.channels().size(), settings.model_error.baseline_floors)),
        settings_(settings) {}

  /// The baseline through the same optimizer as everything else.
  Candidate fit_null() const;

  /// Every chosen effect on top of `from`: a few steps each, and those that come near the best to the end.
  std::vector<Candidate> refit_all(const Candidate& from, const std::vector<Screened>& chosen,
                                   const Candidate& null) const;

  std::vector<Screened> screen_on_top_of(const Candidate& from,
                                         const std::vector<const models::Effect*>& effects) const {
    return screen(Model(set_, base_, from.fit.hypothesis), of_time_, from.amplitudes, from.fit, base_, effects,
                  settings_.threads);
  }

 private:
  void weigh(Candidate& candidate) const;
  Candidate fit_once(const Model& model, const Candidate& null, const Amplitudes& amplitudes,
                     const Eigen::VectorXd& start, int most_iterations) const;
  Candidate fit_candidate(const Model& model, const Candidate& null, const Eigen::VectorXd& start) const;

  const PreparedSet& set_;
  const std::vector<estimation::FreeParameter>& base_;
  const Discrepancy& of_time_;  // model error, and an unknown effect that follows nothing recorded
  Discrepancy of_conditions_;   // an unknown effect that repeats from run to run
  const ComparisonSettings& settings_;
};

void Evaluator::weigh(Candidate& candidate) const {
  const ModelError& error = settings_.model_error;
  const Amplitudes expected = expect_model_error(error, candidate);
  const Evidence evidence(of_time_, candidate.fit.unknowns, candidate.fit.residuals, candidate.fit.jacobian);
  std::vector<AmplitudePrior> small;
  std::vector<AmplitudePrior> free;
  for (const double amplitude : expected) {
    small.push_back(law_amplitude(error.baseline_floors, amplitude));
    free.push_back(free_amplitude(amplitude));
  }
  const Evidence::Sum sum = evidence.integrate(small);
  candidate.log_evidence = sum.log_value;
  candidate.amplitudes = sum.mean;
  const Evidence repeated(of_conditions_, candidate.fit.unknowns, candidate.fit.residuals, candidate.fit.jacobian);
  // What the law of an effect leaves out comes back in like conditions, or does not: as likely one as the other.
  if (!candidate.fit.hypothesis.effects.empty()) {
    candidate.log_evidence = log_sum_exp({sum.log_value, repeated.integrate(small).log_value}) - std::log(2.0);
  }
  // An unknown effect repeats from run to run, or follows nothing recorded: as likely one as the other. On top of an
  // effect it is as likely a distortion of what that effect does.
  std::vector<double> logs{evidence.integrate(free).log_value, repeated.integrate(free).log_value};
  if (!candidate.fit.hypothesis.effects.empty()) {
    std::vector<AmplitudePrior> distorted;
    for (std::size_t c = 0; c < expected.size(); ++c) {
      const double look_alike = std::hypot(error.baseline_floors, error.look_alike_share * candidate.signature[c]);
      distorted.push_back(near_amplitude(std::max(expected[c], look_alike)));  // never less than the law's own error
    }
    logs.push_back(evidence.integrate(distorted).log_value);
    logs.push_back(repeated.integrate(distorted).log_value);
  }
  candidate.log_discrepancy = log_sum_exp(logs) - std::log(static_cast<double>(logs.size()));
}

/// One fit under given model error; weighed under the error in proportion to what it changes.
Candidate Evaluator::fit_once(const Model& model, const Candidate& null, const Amplitudes& amplitudes,
                              const Eigen::VectorXd& start, int most_iterations) const {
  Candidate candidate;
  candidate.fit = refit(model, of_time_, amplitudes, start, 1, most_iterations);
  if (!std::isfinite(candidate.fit.cost)) {
    candidate.log_evidence = candidate.log_discrepancy = kImpossible;
    candidate.signature.assign(amplitudes.size(), 0.0);
    candidate.whole = candidate.signature;
    candidate.amplitudes = amplitudes;
    return candidate;
  }
  candidate.signature = measure_in_floors(set_, candidate.fit.simulated - null.fit.simulated);
  candidate.whole = measure_whole(model, candidate.fit);
  weigh(candidate);
  return candidate;
}

/// Fits a hypothesis from `start`, under model error in proportion to what it changes against `null`: twice, since that
/// change is known after the first fit only.
Candidate Evaluator::fit_candidate(const Model& model, const Candidate& null, const Eigen::VectorXd& start) const {
  const Candidate first = fit_once(model, null, null.amplitudes, start, thresholds::kMostSteps);
  if (!std::isfinite(first.fit.cost)) return first;
  return fit_once(model, null, expect_model_error(settings_.model_error, first), first.fit.unknowns,
                  thresholds::kMostSteps);
}

Candidate Evaluator::fit_null() const {
  const Model model(set_, base_, {});
  Candidate null;
  null.signature.assign(set_.channels().size(), 0.0);
  null.whole = null.signature;
  const Amplitudes expected = expect_model_error(settings_.model_error, null);
  null.fit = refit(model, of_time_, expected, Eigen::VectorXd::Zero(at(model.unknown_count())), settings_.threads);
  if (!std::isfinite(null.fit.cost)) {
    throw RunFailure("the baseline cannot be fitted to the set: it cannot be simulated near its own parameters");
  }
  weigh(null);
  return null;
}

/// Screened effects worth a refit: within 6 nats of the best, the best six at least, and those of which screening could
/// not say anything.
std::vector<Screened> choose(std::vector<Screened> screened, std::size_t least, double nats) {
  std::stable_sort(screened.begin(), screened.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<Screened> chosen;
  for (const Screened& one : screened) {
    const bool is_near = chosen.size() < least || one.score > screened.front().score - nats;
    if (is_near || !one.was_simulated) chosen.push_back(one);
  }
  return chosen;
}

std::vector<Candidate> Evaluator::refit_all(const Candidate& from, const std::vector<Screened>& chosen,
                                            const Candidate& null) const {
  std::vector<Candidate> candidates(chosen.size());
  const auto model_of = [&](std::size_t i) { return Model(set_, base_, from.fit.hypothesis.with(chosen[i].effect)); };
  parallel_for(chosen.size(), settings_.threads, [&](std::size_t i) {
    const Model model = model_of(i);
    const bool is_faint = chosen[i].was_simulated && chosen[i].score < thresholds::kFaint_nats;
    const int steps = is_faint ? 1 : thresholds::kFirstSteps;
    const Eigen::VectorXd start = insert_own(model, from.fit, *chosen[i].effect.effect, chosen[i].own);
    candidates[i] = fit_once(model, null, from.amplitudes, start, steps);
    if (std::isfinite(candidates[i].fit.cost)) return;
    // Where it cannot be simulated with what makes up for its absence: from the middle of all priors.
    const Eigen::VectorXd middle = Eigen::VectorXd::Zero(at(model.unknown_count()));
    candidates[i] = fit_once(model, null, from.amplitudes, middle, steps);
  });
  double best = std::max(from.log_evidence, from.log_discrepancy);
  for (const Candidate& one : candidates) best = std::max({best, one.log_evidence, one.log_discrepancy});
  parallel_for(chosen.size(), settings_.threads, [&](std::size_t i) {
    const bool hopeless =
        std::max(candidates[i].log_evidence, candidates[i].log_discrepancy) <
        best - std::max(thresholds::kHopeless_nats, thresholds::kHopelessShare * (best - from.log_evidence));
    const bool faint = candidates[i].log_evidence < null.log_evidence + thresholds::kWorthFinishing_nats;
    if (hopeless || faint) return;
    candidates[i] = fit_candidate(model_of(i), null, candidates[i].fit.unknowns);
  });
  return candidates;
}

/// Whether two candidates are the same hypothesis, found from two starts.
bool same_hypothesis(const Candidate& a, const Candidate& b) {
  const auto& x = a.fit.hypothesis.effects;
  const auto& y = b.fit.hypothesis.effects;
  return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), [](const auto& p, const auto& q) {
           return p.effect == q.effect && p.sign == q.sign;
         });
}

/// Adds candidates; of one hypothesis found twice the better stays.
void add_candidates(std::vector<Candidate> more, std::vector<Candidate>& all) {
  for (Candidate& one : more) {
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const auto& other) { return same_hypothesis(one, other); });
    if (known == all.end()) {
      all.push_back(std::move(one));
    } else if (one.log_evidence > known->log_evidence) {
      *known = std::move(one);
    }
  }
}

/// Of the two signs of one effect, both halves of its prior.
double sign_share(const Hypothesis& hypothesis) {
  double share = 1.0;
  for (const ActingEffect& on : hypothesis.effects) share /= static_cast<double>(possible_signs(*on.effect).size());
  return share;
}

void assign_probabilities(const ComparisonSettings& settings, Comparison& comparison) {
  const auto n = static_cast<double>(settings.effects.size());
  const auto prior_of = [&](std::size_t effects) {  // of each of its kind
    if (effects == 1) return settings.priors.singles / n;
    if (effects == 2) return settings.priors.pairs / std::max(1.0, n * (n - 1.0) / 2.0);
    return settings.priors.triples / std::max(1.0, n * (n - 1.0) * (n - 2.0) / 6.0);
  };
  std::vector<double> logs{std::log(settings.priors.none) + comparison.null.log_evidence,
                           std::log(settings.priors.unknown) + comparison.null.log_discrepancy};
  for (const Candidate& candidate : comparison.candidates) {
    const double share = sign_share(candidate.fit.hypothesis);
    const double prior = prior_of(candidate.fit.hypothesis.effects.size());
    logs.push_back(std::log(share * prior) + candidate.log_evidence);
    const double look_alike = prior * settings.priors.look_alike / settings.priors.singles;
    logs.push_back(std::log(share * look_alike) + candidate.log_discrepancy);
  }
  const double total = log_sum_exp(logs);
  comparison.null.probability = std::exp(logs[0] - total);
  comparison.null.discrepancy_probability = comparison.unknown_probability = std::exp(logs[1] - total);
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
    comparison.candidates[i].probability = std::exp(logs[2 + 2 * i] - total);
    comparison.candidates[i].discrepancy_probability = std::exp(logs[3 + 2 * i] - total);
    comparison.unknown_probability += comparison.candidates[i].discrepancy_probability;
  }
  std::stable_sort(comparison.candidates.begin(), comparison.candidates.end(),
                   [](const auto& a, const auto& b) { return a.log_evidence > b.log_evidence; });
}

/// On top of the best `firsts` hypotheses of so many effects the `seconds` effects that gain most: those whose score
/// could make up for the smaller prior.
void add_on_top(const Evaluator& evaluator, std::size_t effects, std::size_t firsts, std::size_t seconds,
                Comparison& comparison) {
  std::vector<Candidate> lower;
  for (const Candidate& candidate : comparison.candidates) {
    if (candidate.fit.hypothesis.effects.size() == effects && lower.size() < firsts) lower.push_back(candidate);
  }
  for (const Candidate& first : lower) {
    if (!(first.log_evidence >= comparison.null.log_evidence)) continue;  // nor where it could not be fitted
    std::vector<const models::Effect*> others;
    for (const models::Effect* effect : comparison.effects) {
      if (!first.fit.hypothesis.contains(*effect)) others.push_back(effect);
    }
    std::vector<Screened> screened = evaluator.screen_on_top_of(first, others);
    screened.erase(std::remove_if(screened.begin(), screened.end(),
                                  [](const Screened& one) { return one.score < thresholds::kWorthAdding_nats; }),
                   screened.end());
    if (screened.empty()) continue;
    add_candidates(evaluator.refit_all(first, choose(screened, seconds, 0.0), comparison.null), comparison.candidates);
  }
}

/// Whether the likeliest hypothesis is one of so many effects, alone or with a discrepancy.
bool asks_for(const Comparison& comparison, std::size_t effects) {
  const auto probability_of = [](const Candidate& one) { return one.probability + one.discrepancy_probability; };
  const auto likeliest =
      std::max_element(comparison.candidates.begin(), comparison.candidates.end(),
                       [&](const Candidate& a, const Candidate& b) { return probability_of(a) < probability_of(b); });
  return likeliest != comparison.candidates.end() && likeliest->fit.hypothesis.effects.size() == effects;
}

}  // namespace

Comparison compare_models(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                          const Discrepancy& discrepancy, const ComparisonSettings& settings) {
  const Evaluator evaluator(set, base, discrepancy, settings);
  Comparison comparison;
  comparison.effects = settings.effects;
  comparison.model_error = settings.model_error;
  settings.progress(0.0, "baseline");
  comparison.null = evaluator.fit_null();
  settings.progress(0.1, "screening");
  comparison.screened = evaluator.screen_on_top_of(comparison.null, settings.effects);
  settings.progress(0.2, "refit of effects");
  add_candidates(
      evaluator.refit_all(comparison.null,
                          choose(comparison.screened, thresholds::kScreenedLeast, thresholds::kScreened_nats),
                          comparison.null),
      comparison.candidates);
  assign_probabilities(settings, comparison);
  settings.progress(0.6, "pairs");
  add_on_top(evaluator, 1, thresholds::kFirstsOfPairs, thresholds::kSecondsOfPairs, comparison);
  assign_probabilities(settings, comparison);
  if (asks_for(comparison, 2)) {
    settings.progress(0.9, "triples");
    add_on_top(evaluator, 2, thresholds::kFirstsOfTriples, thresholds::kSecondsOfTriples, comparison);
    assign_probabilities(settings, comparison);
  }
  return comparison;
}

}  // namespace rollrig::diagnosis
