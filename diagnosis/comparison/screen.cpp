#include "diagnosis/comparison/screen.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/comparison/linear_fit.h"
#include "sim/core/parallel.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {

Eigen::VectorXd insert_own(const Model& larger, const Fit& fit, const Term& term, const Eigen::VectorXd& own) {
  Eigen::VectorXd unknowns(to_index(larger.unknown_count()));
  Eigen::Index from = 0;
  Eigen::Index next_own = 0;
  for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const bool is_new = place < larger.own_count() && larger.own_parameters()[place].term == &term;
    unknowns[i] = is_new ? own[next_own++] : fit.unknowns[from++];
  }
  return unknowns;
}

namespace {

/// A size at which a term is tried: its sign, and where in its prior.
struct SizeTrial {
  int sign;
  double u;
};

/// The middle of the prior with each sign that it may have; one prior unit to either side where the middle is the
/// value at which the term does nothing.
std::vector<SizeTrial> find_size_trials(const models::EffectParameter& size) {
  if (size.prior.either_sign) return {{1, 0.0}, {-1, 0.0}};
  const double middle_off = std::abs(size.prior.center() - size.off.value_or(0.0));
  const bool is_two_sided =
      size.prior.scale == models::Prior::Scale::kLinear && middle_off < 0.25 * (size.prior.high - size.prior.low);
  if (is_two_sided) return {{1, 1.0}, {1, -1.0}};
  return {{1, 0.0}};
}

/// Own parameters at that size, and with each shape moved by one prior unit, one at a time.
std::vector<Eigen::VectorXd> find_shape_trials(const Term& term, double size_u) {
  Eigen::VectorXd middle = Eigen::VectorXd::Zero(to_index(term.parameters().size()));
  middle[0] = size_u;
  std::vector<Eigen::VectorXd> trials{middle};
  for (Eigen::Index shape = 1; shape < middle.size(); ++shape) {
    for (const double step : {1.0, -1.0}) {
      trials.push_back(middle);
      trials.back()[shape] = step;
    }
  }
  return trials;
}

/// The size scaled to what the score asks for, in prior units.
double scale_size(const models::EffectParameter& size, const SizeTrial& trial, double ratio) {
  const double off_SI = size.off.value_or(0.0) * unit_of_key(size.key).factor;
  const double tried_SI = from_prior_units(size, trial.u, trial.sign).value_SI;
  constexpr double kSmallest = 0.05;
  return to_prior_units(size, off_SI + std::max(ratio, kSmallest) * (tried_SI - off_SI));
}

/// One term with one sign or side of its size at the best of its shapes; at the first of them without a score where
/// none can be simulated, none where nothing changes.
std::optional<Screened> try_shapes(const Study& study, const LinearFit& linear, const Fit& fit, const Term& term,
                                   const SizeTrial& size) {
  const SignedTerm tried{&term, size.sign};
  const Model larger = study.make_model(fit.hypothesis.with(tried));
  const std::vector<Eigen::VectorXd> trials = find_shape_trials(term, size.u);
  std::optional<Screened> best;
  bool was_simulated = false;
  for (const Eigen::VectorXd& own : trials) {
    Eigen::VectorXd simulated = fit.simulated;
    if (!larger.simulate_added(term, insert_own(larger, fit, term, own), simulated)) continue;
    was_simulated = true;
    const auto [along, variance] = linear.calc_score(simulated - fit.simulated);
    if (!(variance > 0.0)) continue;
    const double score = along > 0.0 ? 0.5 * along * along / variance : 0.0;
    if (best.has_value() && !(score > best->score)) continue;
    best = Screened{tried, own, score, std::sqrt(variance), size.u, along};
    best->own[0] = scale_size(term.parameters().front(), size, along / variance);
  }
  if (!was_simulated) best = Screened{tried, trials.front(), 0.0, 0.0, size.u, 0.0, false};
  return best;
}

}  // namespace

std::vector<Screened> screen(const Study& study, const Candidate& from, const std::vector<const Term*>& terms) {
  const LinearFit linear(study.discrepancy, from);
  std::vector<std::vector<Screened>> found(terms.size());
  parallel_for(terms.size(), study.settings.threads, [&](std::size_t t) {
    for (const SizeTrial& size : find_size_trials(terms[t]->parameters().front())) {
      if (auto one = try_shapes(study, linear, from.fit, *terms[t], size)) found[t].push_back(std::move(*one));
    }
  });
  std::vector<Screened> all;
  for (const auto& of : found) all.insert(all.end(), of.begin(), of.end());
  return all;
}

}  // namespace rollrig::diagnosis
