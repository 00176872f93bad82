#include "validation/scoring/baselines/linearized_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/checks/set_checks.h"
#include "diagnosis/comparison/screen.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::validation {

using diagnosis::to_index;
using models::EffectParameter;

namespace {

diagnosis::StudySettings make_settings(const measurements::MeasurementSet& set, const Settings& settings) {
  diagnosis::StudySettings of_study;
  of_study.terms =
      diagnosis::choose_terms(set.kind->traits, set.tire.model(set.baseline), settings.only, settings.without);
  of_study.threads = 1;
  return of_study;
}

const EffectParameter& size_of(const TriedEffect& tried) { return tried.term.term->parameters().front(); }

struct Size {
  double off = 0.0;
  double tried = 0.0;

  double at_amplitude(double amplitude) const { return off + amplitude * (tried - off); }
};

/// In the unit of the key.
Size find_size(const TriedEffect& tried) {
  const EffectParameter& size = size_of(tried);
  const double factor = unit_of_key(size.key).factor;
  return {size.off.value_or(0.0), diagnosis::from_prior_units(size, tried.own[0], tried.term.sign).value_SI / factor};
}

/// Own parameters with the size at its amplitude.
Eigen::VectorXd scale_own(const ChosenEffect& chosen) {
  const Size size = find_size(chosen.tried);
  const double factor = unit_of_key(size_of(chosen.tried).key).factor;
  Eigen::VectorXd own = chosen.tried.own;
  own[0] = diagnosis::to_prior_units(size_of(chosen.tried), factor * size.at_amplitude(chosen.amplitude));
  return own;
}

}  // namespace

LinearizedSet::LinearizedSet(const measurements::MeasurementSet& measured, const Settings& settings)
    : study_(diagnosis::leave_out(measured, diagnosis::check_set(measured, 1).left_out),
             make_settings(measured, settings)) {
  study_.null = expand({});
  if (study_.null.fit.jacobian.size() == 0) throw RunFailure("the baseline as calibrated cannot be simulated");
}

std::vector<TriedEffect> LinearizedSet::try_effects() const {
  std::vector<TriedEffect> all;
  for (diagnosis::Screened& screened : diagnosis::screen(study_, study_.null, study_.settings.terms)) {
    TriedEffect tried{screened.term, std::move(screened.own), {}};
    const diagnosis::Model model = study_.make_model(diagnosis::Hypothesis{}.with(tried.term));
    const auto simulate = [&] {
      const Eigen::VectorXd unknowns = diagnosis::insert_own(model, study_.null.fit, *tried.term.term, tried.own);
      return model.simulate(unknowns, 1, tried.change, nullptr);
    };
    bool done = simulate();
    if (!done) {
      tried.own[0] = 0.0;  // the middle of its prior
      done = simulate();
    }
    if (!done) continue;
    tried.change -= study_.null.fit.simulated;
    diagnosis::whiten(study_.set, tried.change);
    all.push_back(std::move(tried));
  }
  return all;
}

LinearData LinearizedSet::project(const std::vector<TriedEffect>& tried) const {
  const BaseProjection projection(study_.null.fit.jacobian);
  LinearData data;
  Eigen::MatrixXd changes(study_.null.fit.residuals.size(), to_index(tried.size()));
  for (std::size_t i = 0; i < tried.size(); ++i) {
    changes.col(to_index(i)) = tried[i].change;
    data.effects.push_back(tried[i].term.term->name());
  }
  data.residual = projection.apply(study_.null.fit.residuals);
  data.signatures = projection.apply(changes);
  return data;
}

/// Without derivatives where it cannot be simulated.
diagnosis::Candidate LinearizedSet::expand(const std::vector<ChosenEffect>& chosen) const {
  std::vector<const ChosenEffect*> acting;
  diagnosis::Candidate candidate;
  for (const ChosenEffect& one : chosen) {
    if (candidate.fit.hypothesis.contains(*one.tried.term.term)) continue;
    candidate.fit.hypothesis = candidate.fit.hypothesis.with(one.tried.term);
    acting.push_back(&one);
  }
  const diagnosis::Model model = study_.make_model(candidate.fit.hypothesis);
  diagnosis::Fit& fit = candidate.fit;
  fit.unknowns = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const diagnosis::Model::OwnParameter& own = model.own_parameters()[i];
    const auto of = std::find_if(acting.begin(), acting.end(),
                                 [&](const ChosenEffect* one) { return one->tried.term.term == own.term; });
    const diagnosis::PriorBounds bounds = own.bounds();
    fit.unknowns[to_index(i)] = std::clamp(scale_own(**of)[to_index(own.index)], bounds.lower, bounds.upper);
  }
  candidate.amplitudes.assign(study_.set.channels().size(), 0.0);
  const bool done = model.evaluate(fit.unknowns, 1, fit.residuals, &fit.jacobian) &&
                    model.simulate(fit.unknowns, 1, fit.simulated, nullptr);
  if (!done) fit.jacobian.resize(0, 0);
  return candidate;
}

diagnosis::Gap LinearizedSet::find_gap(const std::vector<ChosenEffect>& chosen,
                                       const diagnosis::BlackBox& black_box) const {
  const diagnosis::Candidate cause = expand(chosen);
  const bool is_cause = !chosen.empty() && cause.fit.jacobian.size() > 0;
  return diagnosis::find_gap(study_, is_cause ? &cause : nullptr, black_box);
}

diagnosis::ParameterEstimate estimate_size(const ChosenEffect& chosen) {
  constexpr double kNormal95 = 1.959963984540054;
  const EffectParameter& declared = size_of(chosen.tried);
  const Size size = find_size(chosen.tried);
  diagnosis::ParameterEstimate estimate;
  estimate.name = fmt::format("{}.{}", chosen.tried.term.term->name(), declared.key);
  estimate.unit = unit_of_key(declared.key).symbol;
  estimate.value = size.at_amplitude(chosen.amplitude);
  estimate.sd = chosen.sd * std::abs(size.tried - size.off);
  estimate.low_95 = estimate.value - kNormal95 * estimate.sd;
  estimate.high_95 = estimate.value + kNormal95 * estimate.sd;
  return estimate;
}

}  // namespace rollrig::validation
