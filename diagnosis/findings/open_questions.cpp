#include "diagnosis/findings/open_questions.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/findings/verdict.h"

namespace rollrig::diagnosis {
namespace {

constexpr std::size_t kMost = 6;
constexpr std::size_t kMostOnBaseline = 9;  // single effects are cheaper to simulate than two
constexpr double kRunnerUp = 0.01;
constexpr double kLeastShare = 0.05;
constexpr double kDetectable = 3.0;  // as for what is not excluded (verdict.cpp)

double probability_of(const Candidate& candidate) { return candidate.probability + candidate.discrepancy_probability; }

/// Fitted hypotheses, the likeliest first, one sign of each.
std::vector<const Candidate*> rank(const Comparison& comparison) {
  std::vector<const Candidate*> all{&comparison.null};
  for (const Candidate& candidate : comparison.candidates) {
    if (std::isfinite(candidate.fit.cost)) all.push_back(&candidate);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate* a, const Candidate* b) { return probability_of(*a) > probability_of(*b); });
  std::vector<const Candidate*> ranked;
  for (const Candidate* one : all) {
    const bool seen = std::any_of(ranked.begin(), ranked.end(), [&](const Candidate* other) {
      return other->fit.hypothesis.ids() == one->fit.hypothesis.ids();
    });
    if (!seen) ranked.push_back(one);
  }
  return ranked;
}

OpenHypothesis describe(const Discrepancy& discrepancy, const Candidate& candidate, double weight) {
  const Evidence evidence(discrepancy, candidate.fit.unknowns, candidate.fit.residuals, candidate.fit.jacobian);
  const Eigen::MatrixXd covariance = evidence.calc_term(candidate.amplitudes, true).covariance;
  const Eigen::Index count = candidate.fit.unknowns.size() - at(discrepancy.set().offset_count());
  return {candidate.fit.hypothesis, candidate.fit.unknowns.head(count),
          covariance.topLeftCorner(count, count).llt().matrixL(), weight};
}

bool is_lead_and_a_trifle(const Candidate& lead, const Candidate& other) {
  return other.fit.hypothesis.effects.size() > lead.fit.hypothesis.effects.size();
}

/// Unknowns that are moved to where they are likeliest, those in `fixed` held where they are.
/// Equation  x = m + C_xf C_ff^-1 (f - m_f): the middle of a normal distribution m, C given f
Eigen::VectorXd move_to_likeliest(const Eigen::VectorXd& unknowns, const Evidence::Term& term,
                                  const std::vector<Eigen::Index>& fixed) {
  const auto count = at(fixed.size());
  Eigen::MatrixXd between(unknowns.size(), count);
  Eigen::MatrixXd own(count, count);
  Eigen::VectorXd back(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index from = fixed[static_cast<std::size_t>(i)];
    between.col(i) = term.covariance.col(from);
    back[i] = -term.step[from];
    for (Eigen::Index j = 0; j < count; ++j) own(i, j) = term.covariance(from, fixed[static_cast<std::size_t>(j)]);
  }
  return unknowns + term.step + between * own.llt().solve(back);
}

/// `lead` with one more effect at the middle of its prior, everything else moved so as to make up for it, and all as
/// uncertain as the set leaves it. None where it cannot be simulated there.
std::optional<OpenHypothesis> add_unseen(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                         const Discrepancy& discrepancy, const Candidate& lead,
                                         const models::Effect& effect, double weight, int threads) {
  const Model larger(set, base, lead.fit.hypothesis.with({&effect, 1}));
  const Eigen::VectorXd middle = Eigen::VectorXd::Zero(at(effect.info.parameters.size()));
  const Eigen::VectorXd unknowns = insert_own(larger, lead.fit, effect, middle);
  Eigen::VectorXd residuals;
  RowMatrix jacobian;
  if (!larger.evaluate(unknowns, threads, residuals, &jacobian)) return std::nullopt;
  const Evidence::Term term = Evidence(discrepancy, unknowns, residuals, jacobian).calc_term(lead.amplitudes, true);
  std::vector<Eigen::Index> added;
  for (std::size_t i = 0; i < larger.own_count(); ++i) {
    if (larger.hypothesis().effects[larger.own_parameters()[i].effect].effect == &effect) added.push_back(at(i));
  }
  Eigen::VectorXd parameters = move_to_likeliest(unknowns, term, added).head(at(larger.parameter_count()));
  for (std::size_t i = 0; i < larger.own_count(); ++i) {
    const PriorBounds bounds = larger.own_bounds(i);
    parameters[at(i)] = std::clamp(parameters[at(i)], bounds.lower, bounds.upper);
  }
  const Eigen::Index count = parameters.size();
  return OpenHypothesis{larger.hypothesis(), parameters, term.covariance.topLeftCorner(count, count).llt().matrixL(),
                        weight};
}

/// Effects that the set would not have shown, the best hidden first.
std::vector<const models::Effect*> find_hidden(const Comparison& comparison) {
  std::vector<std::pair<double, const models::Effect*>> hidden;
  for (const models::Effect* effect : comparison.effects) {
    double detectability = 0.0;  // where no trial of it changes anything
    for (const Screened& one : comparison.screened) {
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
                                                 const std::vector<estimation::FreeParameter>& base,
                                                 const Discrepancy& discrepancy, const Comparison& comparison,
                                                 int threads) {
  const std::vector<const Candidate*> ranked = rank(comparison);
  const Candidate& lead = *ranked.front();
  const bool is_baseline = &lead == &comparison.null;
  const double most = probability_of(lead);
  const double least = kLeastShare * most;
  std::vector<OpenHypothesis> open{describe(discrepancy, lead, most)};
  std::vector<const Candidate*> runners_up;
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    const bool told_apart = expected_log_bayes_factor(discrepancy, lead, *ranked[i]) >= thresholds::kToldApart_nats;
    if (is_baseline || told_apart || is_lead_and_a_trifle(lead, *ranked[i])) {
      if (probability_of(*ranked[i]) >= kRunnerUp) runners_up.push_back(ranked[i]);
    } else if (open.size() < kMost) {
      open.push_back(describe(discrepancy, *ranked[i], most));
    }
  }
  for (const Candidate* other : runners_up) {
    if (open.size() < kMost) open.push_back(describe(discrepancy, *other, std::max(least, probability_of(*other))));
  }
  if (open.size() == 1 || is_baseline) {
    for (const models::Effect* effect : find_hidden(comparison)) {
      const bool is_in = std::any_of(open.begin(), open.end(),
                                     [&](const OpenHypothesis& one) { return one.hypothesis.contains(*effect); });
      if (is_in || open.size() >= (is_baseline ? kMostOnBaseline : kMost)) continue;
      if (auto added = add_unseen(set, base, discrepancy, lead, *effect, least, threads)) open.push_back(*added);
    }
  }
  double sum = 0.0;
  for (const OpenHypothesis& one : open) sum += one.probability;
  for (OpenHypothesis& one : open) one.probability /= sum;
  return open;
}

}  // namespace rollrig::diagnosis
