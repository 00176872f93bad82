#pragma once
/// Test reports of scenarios, by name: docs/add_a_scenario.md says how to add one.

#include <string>
#include <vector>

#include "report/test_report.h"
#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Title, standard and sections of a run's report; what all have in common is added by make_run_report(). `values` has
/// result.json.
using RunReportMaker = TestReport (*)(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                      const ReportValues& values);

TestReport make_iso_28580_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                 const ReportValues& values);

TestReport make_coastdown_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                 const ReportValues& values);

TestReport make_sae_j1634_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome,
                                 const ReportValues& values);

/// nullptr where there is none.
RunReportMaker find_run_report(const std::string& scenario);
/// Scenarios with a report, in the order of `rollrig list`.
std::vector<std::string> list_run_reports();

/// The report of a run, whole: with its uncertainty where `result` has one, its settings, and the files that were read.
TestReport make_run_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome, const Json& result,
                           const std::vector<ReportFile>& files);

}  // namespace rollrig::report
