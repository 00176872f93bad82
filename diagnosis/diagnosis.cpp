#include "diagnosis/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "diagnosis/checks/set_checks.h"
#include "diagnosis/comparison/base_moves.h"
#include "diagnosis/comparison/tire_beliefs.h"
#include "diagnosis/findings/balance.h"
#include "diagnosis/findings/gap.h"
#include "diagnosis/findings/gap_steps.h"
#include "diagnosis/findings/likeness.h"
#include "diagnosis/findings/locations.h"
#include "diagnosis/findings/materiality.h"
#include "diagnosis/findings/open_questions.h"
#include "diagnosis/findings/undetected.h"
#include "diagnosis/findings/verdict.h"
#include "diagnosis/next_test/next_test.h"
#include "sim/core/error.h"

namespace rollrig::diagnosis {
namespace {

/// Throws InputError for a smallest effect of interest that is no share.
void require_smallest_effect(const DiagnosisOptions& options) {
  const double percent = options.smallest_effect_percent;
  if (percent >= 0.0 && percent <= 100.0) return;
  throw InputError({"the smallest effect of interest is not a share", "command line", 0, "--smallest-effect",
                    fmt::format("{}", percent), "0 to 100 percent", ""});
}

/// Terms in the comparison: those that can be seen on the set's machine against its baseline, less those left out.
/// Throws InputError.
std::vector<const Term*> find_terms(const measurements::MeasurementSet& set, const DiagnosisOptions& options) {
  require_valid_options(options);
  std::vector<const Term*> terms =
      choose_terms(set.kind->traits, set.tire.model(set.baseline), options.only, options.without);
  if (terms.empty() && !options.only.empty()) {
    throw InputError({"none of the effects that are to be compared can be seen on such a set", set.path, 0, "--only",
                      fmt::format("{}", fmt::join(options.only, ",")),
                      "effects that act there; --explain NAME says where one does", ""});
  }
  return terms;
}

/// The candidate of the first cause, where something beyond noise is there.
const Candidate* find_lead(const Comparison& comparison, const std::vector<Cause>& causes) {
  if (causes.empty()) return nullptr;
  for (const Candidate& candidate : comparison.candidates) {
    if (candidate.fit.hypothesis.names() == causes.front().effects) return &candidate;
  }
  return nullptr;
}

/// What a fit makes of the sensors, offsets included.
std::vector<double> find_fitted(const Study& study, const Fit& fit) {
  const Eigen::VectorXd left = study.make_model(fit.hypothesis).subtract_from_measured(fit.unknowns, fit.simulated);
  const Eigen::VectorXd fitted = study.set.measured() - left;
  return {fitted.begin(), fitted.end()};
}

/// A set that cannot be what it is said to be has no cause in the catalog, whatever comes near.
void forbid_causes(Diagnosis& diagnosis) {
  for (auto& [hypothesis, probability] : diagnosis.probability) probability = hypothesis == "unknown" ? 1.0 : 0.0;
  diagnosis.causes.clear();
}

/// The first cause on runs that its fit did not see, and what follows for the verdict.
void judge_cause(const Study& study, const Comparison& comparison, Diagnosis& diagnosis) {
  const Candidate* lead = diagnosis.verdict == Verdict::kNoGap ? nullptr : find_lead(comparison, diagnosis.causes);
  diagnosis.gap = find_gap(study, lead);
  diagnosis.gap.steps = find_gap_steps(study, comparison, lead);
  if (diagnosis.verdict == Verdict::kNoGap) return;
  if (lead != nullptr) diagnosis.fitted.with_cause = find_fitted(study, lead->fit);
  weigh_objections(diagnosis.gap, diagnosis.causes, diagnosis.probability);
  diagnosis.verdict = find_verdict(diagnosis.probability, diagnosis.causes);
}

/// Whether a cause with a further effect, which has a tenth of its probability, is large enough to matter.
bool may_matter_with_others(const Study& study, const Comparison& comparison, const Cause& cause,
                            double smallest_effect_percent) {
  constexpr double kLikely = 0.1;
  return std::any_of(comparison.candidates.begin(), comparison.candidates.end(), [&](const Candidate& one) {
    const Hypothesis& hypothesis = one.fit.hypothesis;
    if (hypothesis.has_unknown() || hypothesis.terms.size() <= cause.effects.size()) return false;
    if (one.probability < kLikely * cause.probability || !contains_all(hypothesis.names(), cause.effects)) return false;
    return !is_immaterial(measure_change(study, one), smallest_effect_percent);
  });
}

/// A first cause that is too small to matter is set aside, before anything else is said of it.
void weigh_materiality(const Study& study, const Comparison& comparison, double smallest_effect_percent,
                       Diagnosis& diagnosis) {
  if (diagnosis.verdict == Verdict::kNoGap || diagnosis.causes.empty()) return;
  const Candidate* lead = find_lead(comparison, diagnosis.causes);
  if (lead == nullptr) return;
  diagnosis.causes.front().change = measure_change(study, *lead);
  const bool is_likelier_than_unknown = diagnosis.causes.front().probability > diagnosis.probability.at("unknown");
  if (!is_likelier_than_unknown || !is_immaterial(*diagnosis.causes.front().change, smallest_effect_percent)) return;
  if (may_matter_with_others(study, comparison, diagnosis.causes.front(), smallest_effect_percent)) return;
  diagnosis.trace = set_aside_trace(diagnosis.causes, diagnosis.probability);
  diagnosis.verdict = find_verdict(diagnosis.probability, diagnosis.causes);
}

void add_base_numbers(const Study& study, const Comparison& comparison, Diagnosis& diagnosis) {
  const bool is_caused = diagnosis.verdict != Verdict::kNoGap;
  diagnosis.base_numbers = list_base_numbers(study, is_caused ? find_lead(comparison, diagnosis.causes) : nullptr);
}

/// What the tire's file leaves open, and whether the measurement speaks against it.
void warn_of_tire(const measurements::MeasurementSet& set, const Study& study, Diagnosis& diagnosis) {
  if (is_tire_origin_open(set)) {
    diagnosis.warnings.push_back(
        study.settings.belief == TireBelief::kClass
            ? "the tire file does not say how well its numbers are known, and the measurement asks for more than the "
              "usual uncertainties: they count as class values (docs/diagnosis.md)"
            : "the tire file does not say how well its numbers are known: usual uncertainties are assumed. Add _sd, or "
              "basis = \"measured\" or \"class\"");
  }
  if (diagnosis.verdict != Verdict::kNoGap) return;  // with a cause it is an objection
  const std::string moved = describe_far_moves(study, study.null.fit);
  if (!moved.empty()) diagnosis.warnings.push_back("numbers of the files seem to be wrong: they move by " + moved);
}

Diagnosis diagnose_all_runs(const measurements::MeasurementSet& measured, const DiagnosisOptions& options) {
  StudySettings settings;
  Stages& stages = *settings.stages;
  stages.report = options.progress;
  stages.begin("checks", 0.015);
  const SetChecks checks = check_set(measured, options.threads);
  settings.terms = find_terms(measured, options);
  settings.unknown_terms = choose_unknown_terms(measured.kind->traits, measured.tire.model(measured.baseline));
  settings.threads = options.threads;
  const Beliefs beliefs = compare_beliefs(leave_out(measured, checks.left_out), settings);
  const Study& study = *beliefs.likelier.study;
  const Comparison& comparison = beliefs.likelier.comparison;

  Diagnosis diagnosis;
  diagnosis.set = measured.name;
  diagnosis.probability = find_probabilities(study, comparison);
  diagnosis.causes = find_causes(study, comparison);
  average_over_beliefs(beliefs, diagnosis.probability, diagnosis.causes);
  diagnosis.warnings = checks.warnings;
  diagnosis.doubt = checks.doubt;
  for (const std::size_t r : checks.mistaken_runs) diagnosis.mistaken_runs.insert(measured.runs[r].id);
  if (checks.is_implausible()) forbid_causes(diagnosis);
  diagnosis.verdict = find_verdict(diagnosis.probability, diagnosis.causes);
  weigh_materiality(study, comparison, options.smallest_effect_percent, diagnosis);
  std::vector<Cause> named;
  if (diagnosis.trace.has_value()) {
    named = {*diagnosis.trace};
  } else if (diagnosis.verdict != Verdict::kNoGap) {
    named = diagnosis.causes;
  }
  diagnosis.not_excluded = find_not_excluded(study, comparison, named);
  stages.begin("where and what", 0.76);
  diagnosis.where = find_locations(study);
  diagnosis.balance = find_balance(study);
  stages.begin("next test", 0.99);
  if (!checks.is_implausible()) {
    const std::vector<OpenHypothesis> open = find_open_hypotheses(study, comparison);
    const std::vector<ProposedTest> tests = propose_tests(study, open, options.budget);
    if (!tests.empty()) diagnosis.plan = tests.front();
    diagnosis.next_tests = {tests.begin(), tests.end()};
    diagnosis.next_sensors = propose_sensors(study, open);
  }
  stages.begin("runs left out", 1.0);
  diagnosis.fitted.recalibrated = find_fitted(study, study.null.fit);
  judge_cause(study, comparison, diagnosis);
  if (diagnosis.verdict == Verdict::kUnexplained && !checks.is_implausible()) {
    diagnosis.unknown_like = find_likeness(study, comparison, diagnosis.probability.at("unknown"));
  }
  if (diagnosis.verdict == Verdict::kNoGap && !diagnosis.trace.has_value()) {
    diagnosis.nothing_detectable = average_of(
        beliefs, [](const Belief& belief) { return calc_nothing_detectable(*belief.study, belief.comparison); });
  }
  add_base_numbers(study, comparison, diagnosis);
  warn_of_tire(measured, study, diagnosis);
  if (!checks.left_out.empty()) diagnosis.fitted = {};
  return diagnosis;
}

/// Runs without which the others are looked at, and their share of the gap: those that are in doubt, or the run that
/// holds at least half of a gap that nothing explains. Empty where there is none.
std::pair<std::set<std::string>, double> find_runs_apart(const Diagnosis& diagnosis) {
  constexpr double kMost_percent = 50.0;
  std::map<std::string, double> share_percent;
  for (const Location& at : diagnosis.where) share_percent[at.run] += at.share_percent;
  if (!diagnosis.mistaken_runs.empty()) {
    double sum_percent = 0.0;
    for (const std::string& run : diagnosis.mistaken_runs) sum_percent += share_percent[run];
    return {diagnosis.mistaken_runs, sum_percent};
  }
  for (const auto& [run, share] : share_percent) {
    if (share >= kMost_percent) return {{run}, share};
  }
  return {};
}

/// What the other runs show, where some are in doubt, or one holds most of the gap and nothing explains it.
std::optional<LoneRun> diagnose_without_runs(measurements::MeasurementSet set, const Diagnosis& diagnosis,
                                             DiagnosisOptions options) {
  constexpr std::size_t kFewest = 2;
  const auto [apart, share_percent] = find_runs_apart(diagnosis);
  if (diagnosis.verdict != Verdict::kUnexplained || apart.empty() || set.runs.size() < apart.size() + kFewest) {
    return std::nullopt;
  }
  const std::string names = fmt::format("{}", fmt::join(apart, ", "));
  if (options.progress) {
    options.progress = [report = options.progress, names](double done, const std::string& stage) {
      report(done, fmt::format("without {}: {}", names, stage));
    };
  }
  const auto is_apart = [&runs = apart](const measurements::MeasuredRun& one) { return runs.count(one.id) > 0; };
  set.runs.erase(std::remove_if(set.runs.begin(), set.runs.end(), is_apart), set.runs.end());
  const Diagnosis rest = diagnose_all_runs(set, options);
  LoneRun lone{names, share_percent, rest.verdict, {}, 0.0};
  if (rest.verdict == Verdict::kNoGap) {
    lone.probability = rest.probability.at("none");
  } else if (!rest.causes.empty()) {
    lone.effects = rest.causes.front().effects;
    lone.probability = rest.causes.front().probability;
  }
  return lone;
}

}  // namespace

const ParameterEstimate* find_size(const Cause& cause, const std::string& effect) {
  const auto is_of_effect = [&](const ParameterEstimate& one) { return one.name.rfind(effect + ".", 0) == 0; };
  const auto size = std::find_if(cause.parameters.begin(), cause.parameters.end(), is_of_effect);
  return size == cause.parameters.end() ? nullptr : &*size;
}

void scale_probability(double factor, Cause& cause) {
  cause.probability *= factor;
  if (cause.acts.has_value()) *cause.acts *= factor;
  if (cause.alone.has_value()) *cause.alone *= factor;
  if (cause.complete.has_value()) *cause.complete *= factor;
  for (Partner& partner : cause.partners) partner.probability *= factor;
}

void sort_after_first(std::vector<Cause>& causes) {
  if (causes.empty()) return;
  std::stable_sort(std::next(causes.begin()), causes.end(),
                   [](const Cause& a, const Cause& b) { return a.probability > b.probability; });
}

double probability_of(const Findings& findings, const std::string& name) {
  const auto at = findings.probability.find(name);
  return at == findings.probability.end() ? 0.0 : at->second;
}

void require_valid_options(const DiagnosisOptions& options) {
  for (const auto* named : {&options.without, &options.only}) {
    for (const std::string& name : *named) find_term(name);
  }
  require_smallest_effect(options);
}

Diagnosis diagnose(const measurements::MeasurementSet& set, const DiagnosisOptions& options) {
  require_valid_options(options);
  Diagnosis diagnosis = diagnose_all_runs(set, options);
  diagnosis.only = options.only;
  diagnosis.without = options.without;
  diagnosis.without_run = diagnose_without_runs(set, diagnosis, options);
  return diagnosis;
}

}  // namespace rollrig::diagnosis
