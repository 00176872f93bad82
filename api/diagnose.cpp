#include "rollrig/diagnose.h"

#include "api/data.h"
#include "diagnosis/next_test/plan_files.h"
#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/explain.h"
#include "diagnosis/output/fleet.h"
#include "diagnosis/output/summary.h"
#include "report/diagnosis_page.h"

namespace rollrig {
namespace {

Findings list_findings(const diagnosis::Diagnosis& found) {
  Findings to;
  to.set = found.set;
  to.verdict = static_cast<Verdict>(found.verdict);  // the same three
  to.probability = found.probability;
  for (const diagnosis::Cause& cause : found.causes) {
    to.causes.push_back({cause.effects, cause.probability, cause.indistinguishable_from, {}, cause.objections});
    for (const diagnosis::ParameterEstimate& at : cause.parameters) {
      to.causes.back().parameters.push_back({at.name, at.value, at.sd, at.low_95, at.high_95, at.unit});
    }
  }
  const diagnosis::Gap& gap = found.gap;
  to.gap = {gap.recalibrated.before, gap.recalibrated.after, gap.shrink_percent, gap.shrink_ci95_percent};
  for (const diagnosis::Location& at : found.where) {
    to.where.push_back({at.channel, at.run, at.phase, at.share_percent, at.size, at.unit, at.z, at.start_s, at.end_s});
  }
  for (const diagnosis::NextTest& test : found.next_test) {
    to.next_tests.push_back({test.test, test.splits, test.expected_bits_per_hour, test.hours, test.by_hand});
  }
  to.not_excluded = found.not_excluded;
  to.warnings = found.warnings;
  to.doubt = found.doubt;
  return to;
}

diagnosis::DiagnosisOptions make_options(const DiagnosisOptions& options) {
  return {options.without, options.only, options.threads, options.progress};
}

}  // namespace

Diagnosis diagnose(const MeasurementSet& set, const DiagnosisOptions& options) {
  const auto found =
      std::make_shared<const diagnosis::Diagnosis>(diagnosis::diagnose(set.data().set, make_options(options)));
  Diagnosis result;
  static_cast<Findings&>(result) = list_findings(*found);
  result.text = diagnosis::format_summary(*found);
  result.json = to_text(diagnosis::make_diagnosis_json(*found));
  result.make_page = [set, found] { return report::make_html(report::make_diagnosis_page(set.data().set, *found)); };
  result.make_plan = [set, found] {
    const auto files = diagnosis::write_plan(set.data().set, *found);
    return FolderFiles(files.begin(), files.end());
  };
  return result;
}

FleetDiagnosis diagnose_fleet(const std::vector<std::string>& folders, const DiagnosisOptions& options) {
  const auto fleet =
      std::make_shared<const diagnosis::Fleet>(diagnosis::diagnose_fleet(folders, make_options(options)));
  FleetDiagnosis result;
  for (const diagnosis::FleetMember& one : fleet->members) {
    result.members.push_back({one.folder, one.machine, one.tire, {}, one.failure, one.problem.has_value()});
    if (one.diagnosis.has_value()) result.members.back().findings = list_findings(*one.diagnosis);
  }
  result.text = diagnosis::format_fleet(*fleet);
  result.json = to_text(diagnosis::make_fleet_json(*fleet));
  result.make_page = [fleet] { return report::make_html(report::make_fleet_page(*fleet)); };
  return result;
}

std::string explain_effect(const std::string& name) { return diagnosis::explain_effect(name); }

std::vector<std::string> explainable_names() { return diagnosis::explainable_names(); }

}  // namespace rollrig
