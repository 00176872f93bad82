#include "diagnosis/comparison/evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/comparison/evidence.h"
#include "diagnosis/comparison/law_errors.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace rollrig::diagnosis {
namespace {

/// Assumed: that a tire on several machines does what neither its law nor an effect of the catalog says.
constexpr double kTireUnknown = 0.1;
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// Rms by channel of a difference of block means, in noise floors.
Amplitudes measure_in_floors(const PreparedSet& set, const Eigen::VectorXd& difference) {
  Amplitudes sums(set.channels().size(), 0.0);
  std::vector<std::size_t> counts(set.channels().size(), 0);
  for (const Series& series : set.series()) {
    sums[series.channel] += series.rows_of(difference).squaredNorm() / (series.floor * series.floor);
    counts[series.channel] += series.size();
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    sums[c] = counts[c] > 0 ? std::sqrt(sums[c] / static_cast<double>(counts[c])) : 0.0;
  }
  return sums;
}

/// What the laws of a candidate's terms, the loosest of them, and the baseline may be wrong by, in noise floors.
Amplitudes expect_model_error(ModelError error, const Candidate& candidate) {
  for (const SignedTerm& one : candidate.fit.hypothesis.terms) {
    const models::LawError& own = one.term->info().law_error;
    error.law_share = std::max(error.law_share, own.law_share);
    error.whole_share = std::max(error.whole_share, own.whole_share);
  }
  Amplitudes expected;
  for (std::size_t c = 0; c < candidate.signature.size(); ++c) {
    expected.push_back(std::hypot(error.baseline_floors, error.law_share * candidate.signature[c],
                                  error.whole_share * candidate.whole[c]));
  }
  return expected;
}

/// All that the terms of a fit change, its base parameters held.
Amplitudes measure_whole(const Model& model, const Fit& fit) {
  const Model without(model.set(), model.base(), {});
  Eigen::VectorXd simulated;
  const Eigen::Index own = to_index(model.own_count());
  if (!without.simulate(fit.unknowns.tail(fit.unknowns.size() - own), 1, simulated, nullptr)) {
    return Amplitudes(model.set().channels().size(), 0.0);
  }
  return measure_in_floors(model.set(), fit.simulated - simulated);
}

}  // namespace

Evaluator::Evaluator(const Study& study)
    : study_(study),
      of_conditions_(study.discrepancy,
                     Amplitudes(study.set.channels().size(), study.settings.model_error.baseline_floors)) {
  if (study.set.machine_count() == 1) return;
  const Amplitudes below(study.set.channels().size(), study.settings.model_error.baseline_floors);
  of_tire_.emplace(study.discrepancy, below, Discrepancy::Owner::kTire);
}

void Evaluator::weigh(Candidate& candidate) const {
  const ModelError& error = study_.settings.model_error;
  const Amplitudes expected = expect_model_error(error, candidate);
  const Evidence evidence(study_.discrepancy, candidate.fit);
  std::vector<AmplitudePrior> small;
  std::vector<AmplitudePrior> free;
  for (const double amplitude : expected) {
    small.push_back(law_amplitude(error.baseline_floors, amplitude));
    free.push_back(free_amplitude(amplitude));
  }
  const Evidence::Sum sum = evidence.integrate(small);
  candidate.log_evidence = sum.log_value;
  candidate.amplitudes = sum.mean;
  const Evidence repeated(of_conditions_, candidate.fit);
  // An unknown effect repeats from run to run, or follows nothing recorded: as likely one as the other.
  std::vector<double> logs{evidence.integrate(free).log_value, repeated.integrate(free).log_value};
  if (!candidate.fit.hypothesis.terms.empty()) {
    // What the law of a term leaves out comes back in like conditions, or does not: as likely one as the other.
    candidate.log_evidence = log_sum_exp({sum.log_value, repeated.integrate(small).log_value}) - std::log(2.0);
    // On top of a term an unknown effect is as likely a distortion of what that term does.
    std::vector<AmplitudePrior> distorted;
    for (std::size_t c = 0; c < expected.size(); ++c) {
      const double look_alike = std::hypot(error.baseline_floors, error.look_alike_share * candidate.signature[c]);
      distorted.push_back(near_amplitude(std::max(expected[c], look_alike)));  // never less than the law's own error
    }
    logs.push_back(evidence.integrate(distorted).log_value);
    logs.push_back(repeated.integrate(distorted).log_value);
  }
  candidate.log_discrepancy = log_sum_exp(logs) - std::log(static_cast<double>(logs.size()));
  if (!of_tire_.has_value()) return;
  // The tire may do what its law does not say: on all machines alike, so under every hypothesis.
  const double log_tire = Evidence(*of_tire_, candidate.fit).integrate(free).log_value;
  candidate.log_evidence = log_sum_exp({std::log(1.0 - kTireUnknown) + candidate.log_evidence,
                                        std::log(kTireUnknown) + log_tire});
}

std::optional<double> Evaluator::weigh_with_loose_laws(const Candidate& candidate,
                                                       const std::vector<const Term*>& terms) const {
  const std::optional<Fit> loose = loosen_laws(study_, candidate.fit, terms);
  if (!loose.has_value()) return std::nullopt;
  const ModelError& error = study_.settings.model_error;
  std::vector<AmplitudePrior> small;
  for (const double amplitude : expect_model_error(error, candidate)) {
    small.push_back(law_amplitude(error.baseline_floors, amplitude));
  }
  const Evidence of_time(study_.discrepancy, *loose);
  const Evidence repeated(of_conditions_, *loose);
  const double log_value =
      log_sum_exp({of_time.integrate(small).log_value, repeated.integrate(small).log_value}) - std::log(2.0);
  return std::isfinite(log_value) ? std::optional(log_value) : std::nullopt;
}

/// The laws of its terms are as the catalog has them, or all of them are loose. An unknown effect has no law that could
/// be wrong.
void Evaluator::admit_loose_laws(Candidate& candidate) const {
  if (candidate.fit.hypothesis.has_unknown()) return;
  std::vector<const Term*> terms;
  for (const SignedTerm& one : candidate.fit.hypothesis.terms) terms.push_back(one.term);
  candidate.log_loose = weigh_with_loose_laws(candidate, terms);
  if (!candidate.log_loose.has_value()) return;
  candidate.log_evidence = log_sum_exp({std::log(1.0 - thresholds::kLooseLaw) + candidate.log_evidence,
                                        std::log(thresholds::kLooseLaw) + *candidate.log_loose});
}

/// One fit under given model error; weighed under the error in proportion to what it changes.
Candidate Evaluator::fit_once(const Model& model, const RefitStart& start) const {
  Candidate candidate;
  candidate.fit = refit(model, study_.discrepancy, start);
  if (!std::isfinite(candidate.fit.cost)) {
    candidate.log_evidence = candidate.log_discrepancy = kImpossible;
    candidate.signature.assign(start.amplitudes.size(), 0.0);
    candidate.whole = candidate.signature;
    candidate.amplitudes = start.amplitudes;
    return candidate;
  }
  candidate.signature = measure_in_floors(study_.set, candidate.fit.simulated - study_.null.fit.simulated);
  candidate.whole = measure_whole(model, candidate.fit);
  weigh(candidate);
  return candidate;
}

/// Fits a hypothesis from a fit to it, under model error in proportion to what it changes against the null: twice,
/// since that change is known after the first fit only.
Candidate Evaluator::fit_to_end(const Model& model, const Fit& start) const {
  const int threads = study_.settings.threads;
  const Candidate first =
      fit_once(model, {study_.null.amplitudes, start.unknowns, threads, thresholds::kMostSteps, &start});
  if (!std::isfinite(first.fit.cost)) return first;
  const Amplitudes expected = expect_model_error(study_.settings.model_error, first);
  return fit_once(model, {expected, first.fit.unknowns, threads, thresholds::kMostSteps, &first.fit});
}

Candidate Evaluator::fit_null() const {
  const Model model = study_.make_model({});
  Candidate null;
  null.signature.assign(study_.set.channels().size(), 0.0);
  null.whole = null.signature;
  const Amplitudes expected = expect_model_error(study_.settings.model_error, null);
  null.fit = refit(model, study_.discrepancy,
                   {expected, Eigen::VectorXd::Zero(to_index(model.unknown_count())), study_.settings.threads});
  if (!std::isfinite(null.fit.cost)) {
    throw RunFailure("the baseline cannot be fitted to the set: it cannot be simulated near its own parameters");
  }
  weigh(null);
  if (!std::isfinite(null.log_evidence) || !std::isfinite(null.log_discrepancy)) {
    throw RunFailure(
        "the baseline cannot be weighed against the set: its numbers are beyond what can be computed; are the times of "
        "the rows in seconds?");
  }
  return null;
}

std::vector<Candidate> Evaluator::refit_all(const Candidate& from, const std::vector<Screened>& chosen) const {
  std::vector<Candidate> candidates(chosen.size());
  const auto model_of = [&](std::size_t i) { return study_.make_model(from.fit.hypothesis.with(chosen[i].term)); };
  constexpr double kFirstShare = 0.4;  // of the time
  const Stages& stages = *study_.settings.stages;
  const auto fit_first = [&](std::size_t i) {
    const Model model = model_of(i);
    const bool is_faint = chosen[i].was_simulated && chosen[i].score < thresholds::kFaint_nats;
    const int steps = is_faint ? 1 : thresholds::kFirstSteps;
    const Eigen::VectorXd start = insert_own(model, from.fit, *chosen[i].term.term, chosen[i].own);
    candidates[i] = fit_once(model, {from.amplitudes, start, study_.settings.threads, steps});
    if (std::isfinite(candidates[i].fit.cost)) return;
    // Where it cannot be simulated with what makes up for its absence: from the middle of all priors.
    const Eigen::VectorXd middle = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
    candidates[i] = fit_once(model, {from.amplitudes, middle, study_.settings.threads, steps});
  };
  parallel_for(chosen.size(), study_.settings.threads, fit_first,
               [&](double share) { stages.advance(kFirstShare * share); });
  const auto gain_of = [](const Candidate& one) { return std::max(one.log_evidence, one.log_discrepancy); };
  double best = gain_of(from);
  for (const Candidate& one : candidates) best = std::max(best, gain_of(one));
  const double far_behind =
      best - std::max(thresholds::kHopeless_nats, thresholds::kHopelessShare * (best - from.log_evidence));
  const auto finish = [&](std::size_t i) {
    const bool is_hopeless = gain_of(candidates[i]) < far_behind;
    const bool is_faint = candidates[i].log_evidence < study_.null.log_evidence + thresholds::kWorthFinishing_nats;
    if (is_hopeless || is_faint) return;
    candidates[i] = fit_to_end(model_of(i), candidates[i].fit);
    if (std::isfinite(candidates[i].log_evidence)) admit_loose_laws(candidates[i]);
  };
  parallel_for(chosen.size(), study_.settings.threads, finish,
               [&](double share) { stages.advance(kFirstShare + (1.0 - kFirstShare) * share); });
  return candidates;
}

}  // namespace rollrig::diagnosis
