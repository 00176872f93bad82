#include <fmt/format.h>

#include <algorithm>

#include "estimation/uncertainty/uncertainty.h"
#include "report/test_report.h"

namespace rollrig::report {
namespace {

ReportCell or_infinite(const ReportValues& values, const std::string& place, const char* digits) {
  return values.has(place) ? values.number(place, digits) : ReportCell{"inf"};
}

/// What several inputs on one line do not have in common.
ReportCell or_dash(const ReportValues& values, const std::string& place, const char* digits) {
  return values.has(place) ? values.number(place, digits) : ReportCell{"-"};
}

std::vector<ReportCell> make_contribution_row(const ReportValues& values, const std::string& line) {
  ReportCell name = values.number(line + "/name");
  if (values.json().at(Json::json_pointer(line))["assumed"].get<bool>()) name.text += " *";
  return {name,
          or_dash(values, line + "/value", ".5g"),
          or_dash(values, line + "/standard_uncertainty", ".3g"),
          values.number(line + "/unit"),
          {values.number(line + "/type").text + ", " + values.number(line + "/distribution").text},
          or_infinite(values, line + "/degrees_of_freedom", ".3g"),
          or_dash(values, line + "/sensitivity", ".3g"),
          values.number(line + "/contribution", ".3g"),
          values.number(line + "/share_percent", ".1f")};
}

ReportTable make_budget_report(const ReportValues& values, const std::string& budget) {
  const Json& json = values.json().at(Json::json_pointer(budget));
  const std::string unit = json["unit"].get<std::string>();
  ReportTable table;
  table.title = json["name"].get<std::string>() + (unit.empty() ? "" : ", " + unit);
  table.columns = {"input", "value", "u(x)", "", "type", "dof", "c", "c u(x)", "share, %"};
  for (std::size_t i = 0; i < json["contributions"].size(); ++i) {
    table.rows.push_back(make_contribution_row(values, fmt::format("{}/contributions/{}", budget, i)));
  }
  table.rows.push_back({{"combined standard uncertainty"},
                        values.number(budget + "/value", ".5g"),
                        {},
                        {},
                        {},
                        or_infinite(values, budget + "/effective_degrees_of_freedom", ".3g"),
                        {},
                        values.number(budget + "/combined_standard_uncertainty", ".3g"),
                        {"100"}});
  ReportCell factor = values.number(budget + "/coverage_factor", ".2f");
  table.rows.push_back({{"expanded uncertainty, 95 %, k ="},
                        factor,
                        {},
                        {},
                        {},
                        {},
                        {},
                        values.number(budget + "/expanded_uncertainty", ".3g"),
                        {}});
  table.totals = 2;
  return table;
}

ReportTable make_source_table(const Json& uncertainty) {
  ReportTable table{"Where the uncertainties come from", {"input", "source"}, {}, 0};
  std::vector<std::string> known;
  for (const Json& budget : uncertainty["budgets"]) {
    for (const Json& line : budget["contributions"]) {
      const std::string name = line["name"].get<std::string>();
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      known.push_back(name);
      table.rows.push_back({{name + (line["assumed"].get<bool>() ? " *" : "")}, {line["source"].get<std::string>()}});
    }
  }
  return table;
}

ReportSection make_monte_carlo_section(const ReportValues& values) {
  const std::string place = "/uncertainty/monte_carlo";
  ReportTable table{"", {"result", "", "mean", "sd", "95 % from", "to", "GUM from", "to", "GUM"}, {}, 0};
  ReportSection section{"Monte Carlo beside the GUM", {}};
  const Json& results = values.json()["uncertainty"]["monte_carlo"]["results"];
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string own = fmt::format("{}/results/{}", place, i);
    table.rows.push_back({values.number(own + "/name"), values.number(own + "/unit"),
                          or_dash(values, own + "/mean", ".6g"), or_dash(values, own + "/standard_deviation", ".3g"),
                          values.number(own + "/low_95", ".6g"), values.number(own + "/high_95", ".6g"),
                          values.number(own + "/gum_low_95", ".6g"), values.number(own + "/gum_high_95", ".6g"),
                          values.number(own + "/gum")});
  }
  section.parts.push_back(
      ReportForm{{values.field("Trials", place + "/trials"), values.field("  of them failed", place + "/failed_trials"),
                  values.field("Seed", place + "/seed")}});
  section.parts.push_back(std::move(table));
  for (const Json& result : results) {
    section.parts.push_back(
        ReportText{result["name"].get<std::string>() + ": " + estimation::describe_verdict(result) + "."});
  }
  section.parts.push_back(ReportText{"Propagation of distributions and comparison by JCGM 101:2008, 7 and 8."});
  return section;
}

}  // namespace

std::vector<ReportSection> make_uncertainty_sections(const ReportValues& values) {
  if (!values.has("/uncertainty")) return {};
  const Json& uncertainty = values.json()["uncertainty"];
  std::vector<ReportSection> sections;
  ReportSection budgets{"Uncertainty budget", {}};
  for (std::size_t i = 0; i < uncertainty["budgets"].size(); ++i) {
    budgets.parts.push_back(make_budget_report(values, fmt::format("/uncertainty/budgets/{}", i)));
  }
  budgets.parts.push_back(make_source_table(uncertainty));
  for (const Json& budget : uncertainty["budgets"]) {
    const std::string doubt = estimation::doubt_budget(budget);
    if (!doubt.empty()) budgets.parts.push_back(ReportText{budget["name"].get<std::string>() + ": " + doubt + "."});
  }
  for (const Json& left_out : uncertainty["not_included"]) {
    budgets.parts.push_back(ReportText{"Not included: " + left_out.get<std::string>()});
  }
  budgets.parts.push_back(ReportText{
      "By JCGM 100:2008: u(x) standard uncertainty, c sensitivity coefficient, dof degrees of freedom. * Assumed, "
      "or the accuracy that a regulation asks for: put the figures of your instruments' certificates in its place."});
  sections.push_back(std::move(budgets));
  if (uncertainty.contains("monte_carlo")) sections.push_back(make_monte_carlo_section(values));
  return sections;
}

}  // namespace rollrig::report
