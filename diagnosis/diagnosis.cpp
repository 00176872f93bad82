#include "diagnosis/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/checks/set_checks.h"
#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/findings/balance.h"
#include "diagnosis/findings/gap.h"
#include "diagnosis/findings/locations.h"
#include "diagnosis/findings/open_questions.h"
#include "diagnosis/findings/verdict.h"
#include "diagnosis/next_test/next_test.h"
#include "sim/core/error.h"

namespace rollrig::diagnosis {
namespace {

/// Terms in the comparison: those that can be seen on the set's machine against its baseline, less those left out.
/// Throws InputError.
std::vector<const Term*> find_terms(const measurements::MeasurementSet& set, const DiagnosisOptions& options) {
  require_known_effects(options);
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
  if (lead == nullptr) return;
  diagnosis.fitted.with_cause = find_fitted(study, lead->fit);
  weigh_objections(diagnosis.gap, diagnosis.causes, diagnosis.probability);
  diagnosis.verdict = find_verdict(diagnosis.probability, diagnosis.causes);
}

Diagnosis diagnose_all_runs(const measurements::MeasurementSet& measured, const DiagnosisOptions& options) {
  StudySettings settings;
  Stages& stages = *settings.stages;
  stages.report = options.progress;
  stages.begin("checks", 0.015);
  const SetChecks checks = check_set(measured, options.threads);
  settings.terms = find_terms(measured, options);
  settings.threads = options.threads;
  Study study(leave_out(measured, checks.left_out), settings);
  const Comparison comparison = compare_models(study);

  Diagnosis diagnosis;
  diagnosis.set = measured.name;
  diagnosis.probability = find_probabilities(study, comparison);
  diagnosis.causes = find_causes(study, comparison);
  diagnosis.warnings = checks.warnings;
  diagnosis.doubt = checks.doubt;
  if (checks.is_implausible()) forbid_causes(diagnosis);
  diagnosis.verdict = find_verdict(diagnosis.probability, diagnosis.causes);
  const bool is_named = diagnosis.verdict != Verdict::kNoGap;
  diagnosis.not_excluded = find_not_excluded(study, comparison, is_named ? diagnosis.causes : std::vector<Cause>{});
  stages.begin("where and what", 0.76);
  diagnosis.where = find_locations(study);
  diagnosis.balance = find_balance(study);
  stages.begin("next test", 0.99);
  if (!checks.is_implausible()) {
    const std::vector<OpenHypothesis> open = find_open_hypotheses(study, comparison);
    const std::vector<ProposedTest> tests = propose_tests(study, open);
    if (!tests.empty()) diagnosis.plan = tests.front();
    diagnosis.next_tests = {tests.begin(), tests.end()};
    diagnosis.next_sensors = propose_sensors(study, open);
  }
  stages.begin("runs left out", 1.0);
  diagnosis.fitted.recalibrated = find_fitted(study, study.null.fit);
  judge_cause(study, comparison, diagnosis);
  if (!checks.left_out.empty()) diagnosis.fitted = {};
  return diagnosis;
}

/// The run that holds at least half of a gap; empty where none does.
std::pair<std::string, double> find_lone_run(const std::vector<Location>& where) {
  constexpr double kMost_percent = 50.0;
  std::map<std::string, double> share_percent;
  for (const Location& at : where) share_percent[at.run] += at.share_percent;
  for (const auto& [run, share] : share_percent) {
    if (share >= kMost_percent) return {run, share};
  }
  return {};
}

/// What the other runs show, where one run holds most of the gap and nothing explains it.
std::optional<LoneRun> diagnose_without_run(measurements::MeasurementSet set, const Diagnosis& diagnosis,
                                            DiagnosisOptions options) {
  const auto [run, share_percent] = find_lone_run(diagnosis.where);
  if (diagnosis.verdict != Verdict::kUnexplained || run.empty() || set.runs.size() < 3) return std::nullopt;
  if (options.progress) {
    options.progress = [report = options.progress, run = run](double done, const std::string& stage) {
      report(done, fmt::format("without run {}: {}", run, stage));
    };
  }
  const auto is_lone = [&name = run](const measurements::MeasuredRun& one) { return one.id == name; };
  set.runs.erase(std::remove_if(set.runs.begin(), set.runs.end(), is_lone), set.runs.end());
  const Diagnosis rest = diagnose_all_runs(set, options);
  LoneRun lone{run, share_percent, rest.verdict, {}, 0.0};
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

double probability_of(const Findings& findings, const std::string& name) {
  const auto at = findings.probability.find(name);
  return at == findings.probability.end() ? 0.0 : at->second;
}

void require_known_effects(const DiagnosisOptions& options) {
  for (const auto* named : {&options.without, &options.only}) {
    for (const std::string& name : *named) find_term(name);
  }
}

Diagnosis diagnose(const measurements::MeasurementSet& set, const DiagnosisOptions& options) {
  Diagnosis diagnosis = diagnose_all_runs(set, options);
  diagnosis.without_run = diagnose_without_run(set, diagnosis, options);
  return diagnosis;
}

}  // namespace rollrig::diagnosis
