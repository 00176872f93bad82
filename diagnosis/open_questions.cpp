#include "diagnosis/open_questions.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/verdict.h"

namespace rollrig::diagnosis {
namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

constexpr std::size_t kMost = 6;
constexpr std::size_t kMostOnBaseline = 9;  // single effects are cheaper to simulate than two
constexpr double kRunnerUp = 0.01;
constexpr double kLeastShare = 0.05;
constexpr double kDetectable = 3.0;  // as for what is not excluded (verdict.cpp)

double probability_of(const Contender& contender) { return contender.probability + contender.remainder_probability; }

/// Fitted hypotheses, the likeliest first, one sign of each.
std::vector<const Contender*> rank(const Race& race) {
  std::vector<const Contender*> all{&race.null};
  for (const Contender& contender : race.contenders) {
    if (std::isfinite(contender.fit.cost)) all.push_back(&contender);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Contender* a, const Contender* b) { return probability_of(*a) > probability_of(*b); });
  std::vector<const Contender*> ranked;
  for (const Contender* one : all) {
    const bool seen = std::any_of(ranked.begin(), ranked.end(), [&](const Contender* other) {
      return other->fit.hypothesis.ids() == one->fit.hypothesis.ids();
    });
    if (!seen) ranked.push_back(one);
  }
  return ranked;
}

OpenHypothesis describe(const Remainder& remainder, const Contender& contender, double weight) {
  const Evidence evidence(remainder, contender.fit.unknowns, contender.fit.residuals, contender.fit.jacobian);
  const Eigen::MatrixXd covariance = evidence.calc_term(contender.amplitudes, true).covariance;
  const Eigen::Index count = contender.fit.unknowns.size() - at(remainder.set().offset_count());
  return {contender.fit.hypothesis, contender.fit.unknowns.head(count),
          covariance.topLeftCorner(count, count).llt().matrixL(), weight};
}

bool is_lead_and_a_trifle(const Contender& lead, const Contender& other) {
  return other.fit.hypothesis.effects.size() > lead.fit.hypothesis.effects.size();
}

/// Where in its prior a size is tried: the middle, or one prior unit off where the middle does nothing.
double find_trial_u(const models::EffectParameter& size) {
  const bool does_nothing =
      size.prior.scale == models::Prior::Scale::kLinear && !size.prior.either_sign &&
      std::abs(size.prior.centre() - size.off.value_or(0.0)) < 0.25 * (size.prior.high - size.prior.low);
  return does_nothing ? 1.0 : 0.0;
}

/// `on` with one more effect, of which the prior alone is known.
OpenHypothesis add_unseen(const PreparedSet& set, const std::vector<identification::FreeParameter>& base,
                          const OpenHypothesis& on, const models::Effect& effect, double weight) {
  const Model larger(set, base, on.hypothesis.with({&effect, 1}));
  const Eigen::Index count = at(larger.parameter_count());
  OpenHypothesis added{larger.hypothesis(), Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Zero(count, count), weight};
  std::vector<Eigen::Index> place;  // of the parameters of `on`
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto p = static_cast<std::size_t>(i);
    const bool is_own = p < larger.own_count();
    const bool is_new = is_own && larger.hypothesis().effects[larger.own_parameters()[p].effect].effect == &effect;
    if (!is_new) {
      place.push_back(i);
      continue;
    }
    added.spread(i, i) = 1.0;
    if (larger.own_parameters()[p].index == 0) added.parameters[i] = find_trial_u(effect.info.parameters.front());
  }
  for (std::size_t i = 0; i < place.size(); ++i) {
    added.parameters[place[i]] = on.parameters[at(i)];
    for (std::size_t j = 0; j < place.size(); ++j) added.spread(place[i], place[j]) = on.spread(at(i), at(j));
  }
  return added;
}

/// Effects that the set would not have shown, the best hidden first.
std::vector<const models::Effect*> find_hidden(const Race& race) {
  std::vector<std::pair<double, const models::Effect*>> hidden;
  for (const models::Effect* effect : race.effects) {
    double detectability = 0.0;  // where no trial of it changes anything
    for (const Screened& one : race.screened) {
      if (one.effect.effect == effect) detectability = std::max(detectability, one.detectability);
    }
    if (detectability < kDetectable) hidden.emplace_back(detectability, effect);
  }
  std::stable_sort(hidden.begin(), hidden.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const models::Effect*> effects;
  for (const auto& one : hidden) effects.push_back(one.second);
  return effects;
}

}  // namespace

std::vector<OpenHypothesis> find_open_hypotheses(const PreparedSet& set,
                                                 const std::vector<identification::FreeParameter>& base,
                                                 const Remainder& remainder, const Race& race) {
  const std::vector<const Contender*> ranked = rank(race);
  const Contender& lead = *ranked.front();
  const bool is_baseline = &lead == &race.null;
  const double most = probability_of(lead);
  const double least = kLeastShare * most;
  std::vector<OpenHypothesis> open{describe(remainder, lead, most)};
  std::vector<const Contender*> runners_up;
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    const bool told_apart = expected_log_bayes_factor(remainder, lead, *ranked[i]) >= kToldApart_nats;
    if (is_baseline || told_apart || is_lead_and_a_trifle(lead, *ranked[i])) {
      if (probability_of(*ranked[i]) >= kRunnerUp) runners_up.push_back(ranked[i]);
    } else if (open.size() < kMost) {
      open.push_back(describe(remainder, *ranked[i], most));
    }
  }
  for (const Contender* other : runners_up) {
    if (open.size() < kMost) open.push_back(describe(remainder, *other, std::max(least, probability_of(*other))));
  }
  if (open.size() == 1 || is_baseline) {
    for (const models::Effect* effect : find_hidden(race)) {
      const bool is_in = std::any_of(open.begin(), open.end(),
                                     [&](const OpenHypothesis& one) { return one.hypothesis.contains(*effect); });
      if (!is_in && open.size() < (is_baseline ? kMostOnBaseline : kMost))
        open.push_back(add_unseen(set, base, open.front(), *effect, least));
    }
  }
  double sum = 0.0;
  for (const OpenHypothesis& one : open) sum += one.probability;
  for (OpenHypothesis& one : open) one.probability /= sum;
  return open;
}

}  // namespace rollrig::diagnosis
