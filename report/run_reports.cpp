#include "report/run_reports.h"

#include <fmt/format.h>

#include <map>

#include "report/blocks.h"
#include "scenarios/run/run_spec.h"

namespace rollrig::report {
namespace {

/// Reports by the name of the scenario: one line for each.
const std::map<std::string, RunReportMaker>& run_reports() {
  static const std::map<std::string, RunReportMaker> reports{{"coastdown", &make_coastdown_report},
                                                             {"iso_28580", &make_iso_28580_report},
                                                             {"sae_j1634", &make_sae_j1634_report}};
  return reports;
}

std::string list_active_effects(const scenarios::RunSpec& spec) {
  std::string names;
  for (const models::ActiveEffect& active : spec.effects) {
    names += (names.empty() ? "" : ", ") + active.effect->info.id;
  }
  return names.empty() ? "none" : names;
}

/// Every setting as used, in the order of the scenario.
ReportSection make_settings_section(const Json& settings) {
  ReportTable table{"", {"setting", "value"}, {}, 0};
  for (const auto& [key, value] : settings.items()) {
    if (value.is_null()) continue;
    table.rows.push_back({{key}, {value.is_string() ? value.get<std::string>() : value.dump()}});
  }
  return {"Settings of the simulation", {table}};
}

}  // namespace

RunReportMaker find_run_report(const std::string& scenario) {
  const auto found = run_reports().find(scenario);
  return found == run_reports().end() ? nullptr : found->second;
}

std::vector<std::string> list_run_reports() {
  std::vector<std::string> names;
  for (const std::string& name : scenarios::scenario_names()) {
    if (find_run_report(name) != nullptr) names.push_back(name);
  }
  return names;
}

TestReport make_run_report(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome, const Json& result,
                           const std::vector<ReportFile>& files) {
  const ReportValues values(result);
  TestReport report = find_run_report(spec.scenario->text.name)(spec, outcome, values);
  report.warnings = outcome.warnings;
  for (ReportSection& section : make_uncertainty_sections(values)) report.sections.push_back(std::move(section));
  report.sections.push_back(make_settings_section(outcome.settings));
  report.origin = {make_field("Scenario", spec.scenario->text.name),
                   make_field("Fidelity, baseline", fmt::format("{}, {}", scenarios::name_of(spec.fidelity),
                                                                scenarios::name_of(spec.baseline))),
                   make_field("Effects that were on", list_active_effects(spec)),
                   make_field("Virtual sensors", spec.sensors.has_value() ? "on" : "off: values are without errors"),
                   make_field("Seed", fmt::format("{}", spec.seed))};
  report.files = files;
  return report;
}

}  // namespace rollrig::report
