#include "diagnosis/findings/likeness.h"

#include <cmath>

#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {
namespace {

/// Own parameters of one term of a fit, SI units.
std::vector<double> list_own_SI(const Model& model, const Fit& fit, const Term& term) {
  std::vector<double> own_SI;
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const Model::OwnParameter& own = model.own_parameters()[i];
    if (own.term == &term) own_SI.push_back(own.value_at(fit.unknowns[to_index(i)]).value_SI);
  }
  return own_SI;
}

}  // namespace

std::optional<Likeness> find_likeness(const Study& study, const Comparison& comparison, double unknown_probability) {
  const Candidate* best = nullptr;
  double sum = 0.0;
  for (const Candidate& candidate : comparison.candidates) {
    if (!candidate.fit.hypothesis.has_unknown() || !std::isfinite(candidate.fit.cost)) continue;
    sum += candidate.discrepancy_probability;
    if (best == nullptr || candidate.discrepancy_probability > best->discrepancy_probability) best = &candidate;
  }
  if (best == nullptr || sum < thresholds::kLikeFamily * unknown_probability) return std::nullopt;
  Likeness like;
  for (const SignedTerm& one : best->fit.hypothesis.terms) {
    if (!one.term->is_unknown()) {
      like.beside.push_back(one.term->name());
      continue;
    }
    like.text = *one.term->describe(list_own_SI(study.make_model(best->fit.hypothesis), best->fit, *one.term));
  }
  like.probability = best->discrepancy_probability;
  return like;
}

}  // namespace rollrig::diagnosis
