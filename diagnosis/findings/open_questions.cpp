#include "diagnosis/findings/open_questions.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/comparison/evidence.h"
#include "diagnosis/findings/lead.h"

namespace rollrig::diagnosis {
namespace {

constexpr std::size_t kMost = 6;
constexpr std::size_t kMostOnBaseline = 9;  // one term is cheaper to simulate than two
constexpr double kRunnerUp = 0.01;
constexpr double kLeastShare = 0.05;
constexpr double kDetectable_sd = 3.0;  // Assumed: less detectable terms, the set would not have shown

/// Fitted hypotheses, the likeliest first, one sign of each.
std::vector<const Candidate*> rank(const Study& study, const Comparison& comparison) {
  std::vector<const Candidate*> all{&study.null};
  for (const Candidate& candidate : comparison.candidates) {
    if (std::isfinite(candidate.fit.cost)) all.push_back(&candidate);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate* a, const Candidate* b) { return a->posterior() > b->posterior(); });
  std::vector<const Candidate*> ranked;
  for (const Candidate* one : all) {
    const bool seen = std::any_of(ranked.begin(), ranked.end(), [&](const Candidate* other) {
      return other->fit.hypothesis.names() == one->fit.hypothesis.names();
    });
    if (!seen) ranked.push_back(one);
  }
  return ranked;
}

/// A hypothesis of a study at its parameters, without offsets, each as uncertain as the study leaves it.
OpenHypothesis describe_hypothesis(const Study& study, const Hypothesis& hypothesis, const Eigen::VectorXd& unknowns,
                                   const Eigen::MatrixXd& covariance) {
  const Eigen::Index count = unknowns.size() - to_index(study.set.offset_count());
  return {hypothesis, unknowns.head(count), covariance.topLeftCorner(count, count).llt().matrixL()};
}

OpenHypothesis describe_hypothesis(const Study& study, const Candidate& candidate) {
  const Evidence evidence(study.discrepancy, candidate.fit);
  return describe_hypothesis(study, candidate.fit.hypothesis, candidate.fit.unknowns,
                             evidence.solve(candidate.amplitudes, true).covariance);
}

bool adds_a_term(const Candidate& lead, const Candidate& other) {
  return other.fit.hypothesis.terms.size() > lead.fit.hypothesis.terms.size();
}

/// Unknowns that are moved to where they are likeliest, those in `fixed` held where they are.
/// Equation  x = m + C_xf C_ff^-1 (f - m_f): the middle of a normal distribution m, C given f
Eigen::VectorXd move_to_likeliest(const Eigen::VectorXd& unknowns, const Evidence::Solution& solution,
                                  const std::vector<Eigen::Index>& fixed) {
  const Eigen::MatrixXd between = solution.covariance(Eigen::all, fixed);
  const Eigen::MatrixXd own = solution.covariance(fixed, fixed);
  const Eigen::VectorXd back = -solution.step(fixed);
  return unknowns + solution.step + between * own.llt().solve(back);
}

/// `lead` with one more term at the middle of its prior, everything else moved so as to make up for it, and all as
/// uncertain as the set leaves it. None where it cannot be simulated there.
std::optional<OpenHypothesis> add_unseen(const Study& study, const Candidate& lead, const Term& term) {
  Fit fit;
  fit.hypothesis = lead.fit.hypothesis.with({&term, 1});
  const Model larger = study.make_model(fit.hypothesis);
  const Eigen::VectorXd middle = Eigen::VectorXd::Zero(to_index(term.parameters().size()));
  fit.unknowns = insert_own(larger, lead.fit, term, middle);
  if (!larger.evaluate(fit.unknowns, study.settings.threads, fit.residuals, &fit.jacobian)) return std::nullopt;
  const Evidence::Solution solution = Evidence(study.discrepancy, fit).solve(lead.amplitudes, true);
  std::vector<Eigen::Index> added;
  for (std::size_t i = 0; i < larger.own_count(); ++i) {
    if (larger.own_parameters()[i].term == &term) added.push_back(to_index(i));
  }
  Eigen::VectorXd unknowns = move_to_likeliest(fit.unknowns, solution, added);
  for (std::size_t i = 0; i < larger.own_count(); ++i) {
    const PriorBounds bounds = larger.own_parameters()[i].bounds();
    unknowns[to_index(i)] = std::clamp(unknowns[to_index(i)], bounds.lower, bounds.upper);
  }
  return describe_hypothesis(study, fit.hypothesis, unknowns, solution.covariance);
}

/// Terms that the set would not have shown, the best hidden first.
std::vector<const Term*> find_hidden(const Study& study, const Comparison& comparison) {
  std::vector<const Term*> hidden;
  for (const Term* term : study.settings.terms) {
    if (comparison.find_detectability(*term) < kDetectable_sd) hidden.push_back(term);
  }
  std::stable_sort(hidden.begin(), hidden.end(), [&](const Term* a, const Term* b) {
    return comparison.find_detectability(*a) < comparison.find_detectability(*b);
  });
  return hidden;
}

}  // namespace

std::vector<OpenHypothesis> find_open_hypotheses(const Study& study, const Comparison& comparison) {
  const std::vector<const Candidate*> ranked = rank(study, comparison);
  const Candidate& lead = *ranked.front();
  const bool is_baseline = &lead == &study.null;
  const double most = lead.posterior();
  const double least = kLeastShare * most;
  std::vector<OpenHypothesis> open;
  const auto add = [&open](OpenHypothesis one, double weight) {
    open.push_back(std::move(one));
    open.back().probability = weight;
  };
  add(describe_hypothesis(study, lead), most);
  std::vector<const Candidate*> runners_up;
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    if (is_baseline || is_told_apart(study, lead, *ranked[i]) || adds_a_term(lead, *ranked[i])) {
      if (ranked[i]->posterior() >= kRunnerUp) runners_up.push_back(ranked[i]);
    } else if (open.size() < kMost) {
      add(describe_hypothesis(study, *ranked[i]), most);
    }
  }
  for (const Candidate* other : runners_up) {
    if (open.size() < kMost) add(describe_hypothesis(study, *other), std::max(least, other->posterior()));
  }
  if (open.size() == 1 || is_baseline) {
    for (const Term* term : find_hidden(study, comparison)) {
      const bool is_in = std::any_of(open.begin(), open.end(),
                                     [&](const OpenHypothesis& one) { return one.hypothesis.contains(*term); });
      if (is_in || open.size() >= (is_baseline ? kMostOnBaseline : kMost)) continue;
      if (auto unseen = add_unseen(study, lead, *term)) add(std::move(*unseen), least);
    }
  }
  double sum = 0.0;
  for (const OpenHypothesis& one : open) sum += one.probability;
  for (OpenHypothesis& one : open) one.probability /= sum;
  return open;
}

}  // namespace rollrig::diagnosis
