// The certificate of an alignment. Fields: what EU 2020/740 Annex V Sections 5 and 6 need to be checked.
#include <fmt/format.h>

#include "report/alignment_page.h"

namespace rollrig::report {
namespace {

ReportSection make_alignment_laboratories(const estimation::AlignmentFile& file) {
  const auto named = [](const std::string& label, const std::string& name) {
    return name.empty() ? make_blank(label) : make_field(label, name);
  };
  return {"Laboratories",
          {ReportForm{{make_blank("Candidate laboratory"), named("Machine", file.machine),
                       make_blank("Measurement method and drum of the machine"), make_blank("Reference laboratory"),
                       named("Reference machine", file.reference_machine), make_blank("Certificate number")}}}};
}

ReportSection make_alignment_result(const estimation::AlignmentResult& result, const ReportValues& values) {
  ReportForm form{{values.field("Tire classes", "/classes"),
                   {"A2 of the machine (95 % interval)",
                    {values.number("/line/A2/value", ".4f"), values.number("/line/A2/ci95/0", ".4f"),
                     values.number("/line/A2/ci95/1", ".4f")}},
                   {"B2 of the machine in N/kN (95 % interval)",
                    {values.number("/line/B2_N_per_kN/value", ".4f"), values.number("/line/B2_N_per_kN/ci95/0", ".4f"),
                     values.number("/line/B2_N_per_kN/ci95/1", ".4f")}},
                   result.is_of_network
                       ? ReportField{"A1 of the reference machine, B1 in N/kN",
                                     {values.number("/A1", ".4f"), values.number("/B1_N_per_kN", ".4f")}}
                       : make_blank("A1 of the reference machine, B1 in N/kN"),
                   {"sigma_m in N/kN (95 % interval)",
                    {values.number("/sigma_m_N_per_kN/value", ".3f"), values.number("/sigma_m_N_per_kN/ci95/0", ".3f"),
                     values.number("/sigma_m_N_per_kN/ci95/1", ".3f")}},
                   values.field("First measurement of the machine", "/first_measurement"),
                   values.field("Last measurement of the machine", "/last_measurement")}};
  if (values.has("/last_measurement_of_reference")) {
    form.fields.push_back(
        values.field("Last measurement of the reference machine", "/last_measurement_of_reference"));
  }
  form.fields.push_back(values.field("Valid from", "/valid_from"));
  form.fields.push_back(values.field("Valid until, unless the machine is changed or drifts", "/valid_until"));
  form.fields.push_back(values.field("Judged on", "/judged_on"));
  form.fields.push_back(make_field("Verdict", describe_alignment_verdict(result)));
  for (const Json& reason : values.json()["align_again_because"]) {
    form.fields.push_back(make_field("Align again", reason.get<std::string>()));
  }
  return {"Alignment",
          {ReportText{"RRc aligned = A1 (A2 RRc measured + B2) + B1, with RRc measured at 25 °C and for the 2 m drum."},
           form}};
}

ReportTable make_alignment_tires(const ReportValues& values) {
  ReportTable table{
      "Alignment tires", {"tire", "class", "used", "measured, N/kN", "reference, N/kN", "residual, N/kN"}, {}, 0};
  for (std::size_t i = 0; i < values.json()["tires"].size(); ++i) {
    const std::string tire = fmt::format("/tires/{}", i);
    table.rows.push_back({values.value(tire + "/tire"), values.value(tire + "/class"),
                          values.number(tire + "/used", "d"), values.number(tire + "/measured_N_per_kN", ".3f"),
                          values.number(tire + "/reference_N_per_kN", ".3f"),
                          values.number(tire + "/residual_N_per_kN", "+.3f")});
  }
  return table;
}

ReportSection make_alignment_checks(const estimation::AlignmentResult& result) {
  ReportTable rules{"Rules", {"check", "found", "limit", "met", "source"}, {}, 0};
  ReportTable advice{"Advice", rules.columns, {}, 0};
  for (const AlignmentCheck& check : result.checks) {
    (check.is_rule ? rules : advice)
        .rows.push_back({{check.name}, {check.found}, {check.limit}, {check.is_met ? "yes" : "NO"}, {check.source}});
  }
  return {"Checks", {rules, advice}};
}

ReportSection make_alignment_uncertainty(const estimation::AlignmentResult& result) {
  const double x = result.fit.mean_x;
  const estimation::UncertainValue aligned = estimation::align_value(result.line, x, 1);
  ReportTable table{fmt::format("One measurement of {:.2f} N/kN, aligned to {:.2f} N/kN", x, aligned.value),
                    {"contribution", "u, N/kN", "degrees of freedom", "share, %"},
                    {},
                    1};
  for (const estimation::AlignedContribution& one : aligned.contributions) {
    table.rows.push_back({{one.name},
                          {fmt::format("{:.4f}", one.sd)},
                          {fmt::format("{:.0f}", one.degrees_of_freedom)},
                          {fmt::format("{:.1f}", 100.0 * one.sd * one.sd / (aligned.sd * aligned.sd))}});
  }
  table.rows.push_back({{fmt::format("combined; expanded {:.3f} N/kN (95 %, k = {:.2f})",
                                     aligned.coverage_factor * aligned.sd, aligned.coverage_factor)},
                        {fmt::format("{:.4f}", aligned.sd)},
                        {fmt::format("{:.0f}", aligned.degrees_of_freedom)},
                        {"100.0"}});
  return {"Uncertainty of an aligned value",
          {ReportText{"Without the uncertainty of A1 and B1, which the reference laboratory states."}, table}};
}

}  // namespace

TestReport make_alignment_report(const estimation::AlignmentFile& file, const estimation::AlignmentResult& result,
                                 const Json& json, const std::vector<ReportFile>& files) {
  const ReportValues values(json);
  TestReport report;
  report.title = "Certificate: alignment of a rolling-resistance machine";
  report.standard =
      "Regulation (EU) 2020/740, Annex V, Sections 5 and 6. The limits of Section 2.2 and of UN R117 Annex 6 are "
      "second-hand.";
  report.subject =
      fmt::format("Machine {}, classes {}", file.machine.empty() ? file.path : file.machine, file.rules.classes);
  report.is_simulated = false;
  report.warnings = result.warnings;
  report.sections = {make_alignment_laboratories(file),
                     make_alignment_result(result, values),
                     {"Tires", {make_alignment_tires(values)}},
                     make_alignment_checks(result)};
  std::vector<ReportSection> uncertainty = make_uncertainty_sections(values);
  if (uncertainty.empty()) uncertainty.push_back(make_alignment_uncertainty(result));
  for (ReportSection& section : uncertainty) report.sections.push_back(std::move(section));
  if (!result.monitoring.charts.empty()) {
    ReportSection controls{"Control tires", {}};
    for (const Table& table : make_control_tire_tables(result)) controls.parts.push_back(make_report_table(table));
    report.sections.push_back(controls);
  }
  report.files = files;
  return report;
}

}  // namespace rollrig::report
