#include "diagnosis/comparison/race.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// A free remainder: in each channel either as small as model error, or of any size up to a hundred floors.
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
    error.law_share = std::max(error.law_share, own.here_and_there);
    error.whole_share = std::max(error.whole_share, own.everywhere);
  }
  return error;
}

Amplitudes expect_model_error(const ModelError& usual, const Contender& contender) {
  const ModelError error = loosen(usual, contender.fit.hypothesis);
  Amplitudes expected;
  for (std::size_t c = 0; c < contender.signature.size(); ++c) {
    expected.push_back(std::hypot(error.baseline_floors, error.law_share * contender.signature[c],
                                  error.whole_share * contender.whole[c]));
  }
  return expected;
}

/// All that the effects of a fit change, its base parameters held.
Amplitudes measure_whole(const Model& model, const Fit& fit) {
  const Model without(model.set(), model.base(), {});
  Eigen::VectorXd simulated;
  const Eigen::Index own = at(model.own_count());
  if (!without.simulate(fit.unknowns.tail(fit.unknowns.size() - own), 1, simulated, nullptr, true)) {
    return Amplitudes(model.set().channels().size(), 0.0);
  }
  return measure_in_floors(model.set(), fit.simulated - simulated);
}

/// What all fits of a race share.
class Referee {
 public:
  Referee(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base, const Remainder& remainder,
          const RaceSettings& settings)
      : set_(set),
        base_(base),
        of_time_(remainder),
        of_conditions_(remainder, Amplitudes(set.channels().size(), settings.model_error.baseline_floors)),
        settings_(settings) {}

  /// The baseline through the same optimiser as everything else.
  Contender fit_null() const;

  /// Every chosen effect on top of `from`: a few steps each, and those that come near the best to the end.
  std::vector<Contender> refit_all(const Contender& from, const std::vector<Screened>& chosen,
                                   const Contender& null) const;

  std::vector<Screened> screen_on_top_of(const Contender& from,
                                         const std::vector<const models::Effect*>& effects) const {
    return screen(Model(set_, base_, from.fit.hypothesis), of_time_, from.amplitudes, from.fit, base_, effects,
                  settings_.threads);
  }

 private:
  void weigh(Contender& contender) const;
  Contender fit_once(const Model& model, const Contender& null, const Amplitudes& amplitudes,
                     const Eigen::VectorXd& start, int most_iterations) const;
  Contender fit_contender(const Model& model, const Contender& null, const Eigen::VectorXd& start) const;

  const PreparedSet& set_;
  const std::vector<estimation::FreeParameter>& base_;
  const Remainder& of_time_;  // model error, and an unknown effect that follows nothing recorded
  Remainder of_conditions_;   // an unknown effect that repeats from run to run
  const RaceSettings& settings_;
};

void Referee::weigh(Contender& contender) const {
  const ModelError& error = settings_.model_error;
  const Amplitudes expected = expect_model_error(error, contender);
  const Evidence evidence(of_time_, contender.fit.unknowns, contender.fit.residuals, contender.fit.jacobian);
  std::vector<AmplitudePrior> small;
  std::vector<AmplitudePrior> free;
  for (const double amplitude : expected) {
    small.push_back(law_amplitude(error.baseline_floors, amplitude));
    free.push_back(free_amplitude(amplitude));
  }
  const Evidence::Sum sum = evidence.integrate(small);
  contender.log_evidence = sum.log_value;
  contender.amplitudes = sum.mean;
  const Evidence repeated(of_conditions_, contender.fit.unknowns, contender.fit.residuals, contender.fit.jacobian);
  // What the law of an effect leaves out comes back in like conditions, or does not: as likely one as the other.
  if (!contender.fit.hypothesis.effects.empty()) {
    contender.log_evidence = log_sum_exp({sum.log_value, repeated.integrate(small).log_value}) - std::log(2.0);
  }
  // An unknown effect repeats from run to run, or follows nothing recorded: as likely one as the other. On top of an
  // effect it is as likely a distortion of what that effect does.
  std::vector<double> logs{evidence.integrate(free).log_value, repeated.integrate(free).log_value};
  if (!contender.fit.hypothesis.effects.empty()) {
    std::vector<AmplitudePrior> distorted;
    for (std::size_t c = 0; c < expected.size(); ++c) {
      const double look_alike = std::hypot(error.baseline_floors, error.look_alike_share * contender.signature[c]);
      distorted.push_back(near_amplitude(std::max(expected[c], look_alike)));  // never less than the law's own error
    }
    logs.push_back(evidence.integrate(distorted).log_value);
    logs.push_back(repeated.integrate(distorted).log_value);
  }
  contender.log_remainder = log_sum_exp(logs) - std::log(static_cast<double>(logs.size()));
}

/// One fit under given model error; weighed under the error in proportion to what it changes.
Contender Referee::fit_once(const Model& model, const Contender& null, const Amplitudes& amplitudes,
                            const Eigen::VectorXd& start, int most_iterations) const {
  Contender contender;
  contender.fit = refit(model, of_time_, amplitudes, start, 1, most_iterations);
  if (!std::isfinite(contender.fit.cost)) {
    contender.log_evidence = contender.log_remainder = kImpossible;
    contender.signature.assign(amplitudes.size(), 0.0);
    contender.whole = contender.signature;
    contender.amplitudes = amplitudes;
    return contender;
  }
  contender.signature = measure_in_floors(set_, contender.fit.simulated - null.fit.simulated);
  contender.whole = measure_whole(model, contender.fit);
  weigh(contender);
  return contender;
}

/// Fits a hypothesis from `start`, under model error in proportion to what it changes against `null`: twice, since that
/// change is known after the first fit only.
Contender Referee::fit_contender(const Model& model, const Contender& null, const Eigen::VectorXd& start) const {
  const Contender first = fit_once(model, null, null.amplitudes, start, thresholds::kMostSteps);
  if (!std::isfinite(first.fit.cost)) return first;
  return fit_once(model, null, expect_model_error(settings_.model_error, first), first.fit.unknowns,
                  thresholds::kMostSteps);
}

Contender Referee::fit_null() const {
  const Model model(set_, base_, {});
  Contender null;
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

std::vector<Contender> Referee::refit_all(const Contender& from, const std::vector<Screened>& chosen,
                                          const Contender& null) const {
  std::vector<Contender> contenders(chosen.size());
  const auto model_of = [&](std::size_t i) { return Model(set_, base_, from.fit.hypothesis.with(chosen[i].effect)); };
  parallel_for(chosen.size(), settings_.threads, [&](std::size_t i) {
    const Model model = model_of(i);
    const bool is_faint = chosen[i].was_simulated && chosen[i].score < thresholds::kFaint_nats;
    const int steps = is_faint ? 1 : thresholds::kFirstSteps;
    const Eigen::VectorXd start = insert_own(model, from.fit, *chosen[i].effect.effect, chosen[i].own);
    contenders[i] = fit_once(model, null, from.amplitudes, start, steps);
    if (std::isfinite(contenders[i].fit.cost)) return;
    // Where it cannot be simulated with what makes up for its absence: from the middle of all priors.
    const Eigen::VectorXd middle = Eigen::VectorXd::Zero(at(model.unknown_count()));
    contenders[i] = fit_once(model, null, from.amplitudes, middle, steps);
  });
  double best = std::max(from.log_evidence, from.log_remainder);
  for (const Contender& one : contenders) best = std::max({best, one.log_evidence, one.log_remainder});
  parallel_for(chosen.size(), settings_.threads, [&](std::size_t i) {
    const bool hopeless =
        std::max(contenders[i].log_evidence, contenders[i].log_remainder) <
        best - std::max(thresholds::kHopeless_nats, thresholds::kHopelessShare * (best - from.log_evidence));
    const bool faint = contenders[i].log_evidence < null.log_evidence + thresholds::kWorthFinishing_nats;
    if (hopeless || faint) return;
    contenders[i] = fit_contender(model_of(i), null, contenders[i].fit.unknowns);
  });
  return contenders;
}

/// Whether two contenders are the same hypothesis, found from two starts.
bool same_hypothesis(const Contender& a, const Contender& b) {
  const auto& x = a.fit.hypothesis.effects;
  const auto& y = b.fit.hypothesis.effects;
  return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), [](const auto& p, const auto& q) {
           return p.effect == q.effect && p.sign == q.sign;
         });
}

/// Adds contenders; of one hypothesis found twice the better stays.
void add_contenders(std::vector<Contender> more, std::vector<Contender>& all) {
  for (Contender& one : more) {
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

void assign_probabilities(const RaceSettings& settings, Race& race) {
  const auto n = static_cast<double>(settings.effects.size());
  const auto prior_of = [&](std::size_t effects) {  // of each of its kind
    if (effects == 1) return settings.priors.singles / n;
    if (effects == 2) return settings.priors.pairs / std::max(1.0, n * (n - 1.0) / 2.0);
    return settings.priors.triples / std::max(1.0, n * (n - 1.0) * (n - 2.0) / 6.0);
  };
  std::vector<double> logs{std::log(settings.priors.none) + race.null.log_evidence,
                           std::log(settings.priors.unknown) + race.null.log_remainder};
  for (const Contender& contender : race.contenders) {
    const double share = sign_share(contender.fit.hypothesis);
    const double prior = prior_of(contender.fit.hypothesis.effects.size());
    logs.push_back(std::log(share * prior) + contender.log_evidence);
    const double look_alike = prior * settings.priors.look_alike / settings.priors.singles;
    logs.push_back(std::log(share * look_alike) + contender.log_remainder);
  }
  const double total = log_sum_exp(logs);
  race.null.probability = std::exp(logs[0] - total);
  race.null.remainder_probability = race.unknown_probability = std::exp(logs[1] - total);
  for (std::size_t i = 0; i < race.contenders.size(); ++i) {
    race.contenders[i].probability = std::exp(logs[2 + 2 * i] - total);
    race.contenders[i].remainder_probability = std::exp(logs[3 + 2 * i] - total);
    race.unknown_probability += race.contenders[i].remainder_probability;
  }
  std::stable_sort(race.contenders.begin(), race.contenders.end(),
                   [](const auto& a, const auto& b) { return a.log_evidence > b.log_evidence; });
}

/// On top of the best `firsts` hypotheses of so many effects the `seconds` effects that gain most: those whose score
/// could make up for the smaller prior.
void add_on_top(const Referee& referee, std::size_t effects, std::size_t firsts, std::size_t seconds, Race& race) {
  std::vector<Contender> lower;
  for (const Contender& contender : race.contenders) {
    if (contender.fit.hypothesis.effects.size() == effects && lower.size() < firsts) lower.push_back(contender);
  }
  for (const Contender& first : lower) {
    if (!(first.log_evidence >= race.null.log_evidence)) continue;  // nor where it could not be fitted
    std::vector<const models::Effect*> others;
    for (const models::Effect* effect : race.effects) {
      if (!first.fit.hypothesis.contains(*effect)) others.push_back(effect);
    }
    std::vector<Screened> screened = referee.screen_on_top_of(first, others);
    screened.erase(std::remove_if(screened.begin(), screened.end(),
                                  [](const Screened& one) { return one.score < thresholds::kWorthAdding_nats; }),
                   screened.end());
    if (screened.empty()) continue;
    add_contenders(referee.refit_all(first, choose(screened, seconds, 0.0), race.null), race.contenders);
  }
}

/// Whether the likeliest hypothesis is one of so many effects, alone or with a remainder.
bool asks_for(const Race& race, std::size_t effects) {
  const auto probability_of = [](const Contender& one) { return one.probability + one.remainder_probability; };
  const auto likeliest =
      std::max_element(race.contenders.begin(), race.contenders.end(),
                       [&](const Contender& a, const Contender& b) { return probability_of(a) < probability_of(b); });
  return likeliest != race.contenders.end() && likeliest->fit.hypothesis.effects.size() == effects;
}

}  // namespace

Race run_race(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base, const Remainder& remainder,
              const RaceSettings& settings) {
  const Referee referee(set, base, remainder, settings);
  Race race;
  race.effects = settings.effects;
  race.model_error = settings.model_error;
  settings.progress(0.0, "baseline");
  race.null = referee.fit_null();
  settings.progress(0.1, "screening");
  race.screened = referee.screen_on_top_of(race.null, settings.effects);
  settings.progress(0.2, "refit of effects");
  add_contenders(
      referee.refit_all(race.null, choose(race.screened, thresholds::kScreenedLeast, thresholds::kScreened_nats),
                        race.null),
      race.contenders);
  assign_probabilities(settings, race);
  settings.progress(0.6, "pairs");
  add_on_top(referee, 1, thresholds::kFirstsOfPairs, thresholds::kSecondsOfPairs, race);
  assign_probabilities(settings, race);
  if (asks_for(race, 2)) {
    settings.progress(0.9, "triples");
    add_on_top(referee, 2, thresholds::kFirstsOfTriples, thresholds::kSecondsOfTriples, race);
    assign_probabilities(settings, race);
  }
  return race;
}

}  // namespace rollrig::diagnosis
