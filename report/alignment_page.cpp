#include "report/alignment_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/blocks.h"
#include "sim/core/text.h"

namespace rollrig::report {
namespace {

using estimation::AlignmentFile;
using estimation::AlignmentResult;
using estimation::AlignmentTire;
using estimation::ControlChart;
using estimation::LineFit;
using estimation::LinePoint;
using estimation::UncertainValue;

std::string show_with_interval(double value, double sd, double k) {
  return fmt::format("{:.4f} ({:.4f} to {:.4f})", value, value - k * sd, value + k * sd);
}

std::string name_or(const std::string& name, const char* none) { return name.empty() ? none : name; }

std::string show_sigma(const estimation::ScatterEstimate& sigma) {
  return fmt::format("{:.3f} N/kN ({:.3f} to {:.3f}), {:.0f} degrees of freedom", sigma.sd, sigma.low_95, sigma.high_95,
                     sigma.degrees_of_freedom);
}

Table make_alignment_overview(const AlignmentFile& file, const AlignmentResult& result) {
  const LineFit& fit = result.fit;
  const estimation::AlignmentLine& line = result.line;
  const double k = fit.coverage_factor();
  Table table{"", {}, {}};
  const auto add = [&table](const std::string& label, const std::string& value) {
    table.rows.push_back({label, value});
  };
  add("machine", name_or(file.machine, "as the file has it"));
  add("aligned to", file.is_assigned ? "assigned values of the network"
                                     : name_or(file.reference_machine, "values of the reference laboratory"));
  add("measured", fmt::format("{} to {}", estimation::format_day(file.first_s), estimation::format_day(file.last_s)));
  add("A2, of the machine", show_with_interval(fit.slope, fit.slope_sd(), k));
  add("B2, of the machine", show_with_interval(fit.offset, fit.offset_sd(), k) + " N/kN");
  if (!file.is_assigned && result.is_of_network) {
    add("A1, B1 of the reference", fmt::format("{:.4f}, {:.4f} N/kN", line.A1, line.B1));
  }
  add("RRc aligned", fmt::format("{:.4f} x RRc measured {} {:.4f} N/kN", line.calc_factor(),
                                 line.calc_offset() < 0.0 ? '-' : '+', std::abs(line.calc_offset())));
  add("sigma_m of the machine", show_sigma(result.sigma_m));
  if (result.sigma_l.has_value()) add("sigma_m of the reference machine", show_sigma(*result.sigma_l));
  add("valid until",
      fmt::format("{}, unless the machine is changed or drifts", estimation::format_day(result.valid_until_s)));
  add("verdict", describe_alignment_verdict(result));
  for (const std::string& reason : result.due_because) add("align again", reason);
  return table;
}

Table make_alignment_tire_table(const AlignmentFile& file, const AlignmentResult& result) {
  Table table{"Alignment tires: N/kN, means of the measurements that are used",
              {"tire", "class", "used", "measured", "reference", "residual", "leverage"},
              {}};
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    const LinePoint& point = result.fit.points[i];
    table.rows.push_back({file.tires[i].name, file.tires[i].tire_class,
                          fmt::format("{}", file.tires[i].candidate.used().size()), fmt::format("{:.3f}", point.x),
                          fmt::format("{:.3f}", point.y), fmt::format("{:+.3f}", point.residual),
                          fmt::format("{:.2f}", point.leverage)});
  }
  return table;
}

Table make_aligned_range_table(const AlignmentResult& result) {
  Table table{"Aligned values: N/kN, with U of 95 % of one measurement and of the mean of three",
              {"measured", "aligned", "U, one", "U, three"},
              {}};
  const auto show = [](double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); };
  for (const estimation::AlignedExample& at : estimation::list_aligned_examples(result)) {
    table.rows.push_back({show(at.measured_N_per_kN, 2), show(at.aligned_N_per_kN, 2),
                          show(at.expanded_of_one_N_per_kN, 3), show(at.expanded_of_three_N_per_kN, 3)});
  }
  return table;
}

Table make_check_table(const AlignmentResult& result, bool rules) {
  Table table{rules ? "Rules" : "Advice", {"check", "found", "limit", "met", "source"}, {}};
  table.page_only = 1;
  for (const AlignmentCheck& check : result.checks) {
    if (check.is_rule != rules) continue;
    table.rows.push_back({check.name, check.found, check.limit, check.is_met ? "yes" : "NO", check.source});
  }
  return table;
}

Table make_control_table(const AlignmentResult& result) {
  Table table{"Control tires: N/kN", {"tire", "n", "mean", "sd", "limits", "outside"}, {}};
  for (const ControlChart& chart : result.monitoring.charts) {
    const bool has_scatter = chart.rrc_N_per_kN.size() > 1;
    table.rows.push_back({chart.tire, fmt::format("{}", chart.rrc_N_per_kN.size()),
                          fmt::format("{:.3f}", chart.center_N_per_kN),
                          has_scatter ? fmt::format("{:.3f}", chart.sd_N_per_kN) : "-",
                          has_scatter ? fmt::format("{:.3f} to {:.3f}", chart.low_N_per_kN, chart.high_N_per_kN) : "-",
                          fmt::format("{}", chart.outside.size())});
  }
  return table;
}

Table make_drift_table(const estimation::ControlMonitoring& monitoring) {
  const estimation::ControlDrift& drift = *monitoring.drift;
  Table table{"",
              {},
              {{"drift", fmt::format("{:+.3f} N/kN a year ({:+.3f} to {:+.3f}), p = {}", drift.N_per_kN_per_year,
                                     drift.low_95, drift.high_95,
                                     estimation::format_p_value(drift.p_value, estimation::kDriftLevel))}}};
  if (const auto& shift = monitoring.shift; shift.has_value()) {
    table.rows.push_back({"shift", fmt::format("{:+.3f} N/kN from {} on, p = {}", shift->by_N_per_kN,
                                               estimation::format_day(shift->from_s),
                                               estimation::format_p_value(shift->p_value, estimation::kShiftLevel))});
  }
  return table;
}

Block make_line_chart(const AlignmentResult& result) {
  ChartSeries tires, line;
  const LineFit& fit = result.fit;
  for (const LinePoint& point : fit.points) tires.add(point.x, point.y);
  for (const double x : {fit.points.front().x, fit.points.back().x}) line.add(x, fit.value(x));
  return make_curves({"RRc on this machine", "N/kN"}, {"RRc of the reference", "N/kN"},
                     Json::array({tires.finish("alignment tires"), line.finish("A2 RRc + B2", "line")}));
}

Block make_alignment_residual_chart(const AlignmentResult& result) {
  ChartSeries points;
  const LineFit& fit = result.fit;
  const double half = 2.0 * fit.repeat_sd;
  for (const LinePoint& point : fit.points) {
    points.add(point.x, point.residual, point.residual - half, point.residual + half);
  }
  Block block =
      make_curves({"RRc on this machine", "N/kN"}, {"Reference minus line", "N/kN"},
                  Json::array({points.finish("alignment tires")}), "Bars: two standard deviations by the repeats.");
  block["marks"] = {0.0};
  return block;
}

Block make_control_chart(const ControlChart& chart) {
  ChartSeries points;
  for (std::size_t i = 0; i < chart.time_s.size(); ++i) {
    points.add((chart.time_s[i] - chart.time_s.front()) / 86400.0, chart.rrc_N_per_kN[i]);
  }
  Block block = make_curves({fmt::format("Days since {}", estimation::format_day(chart.time_s.front())), ""},
                            {"RRc of " + chart.tire, "N/kN"}, Json::array({points.finish(chart.tire)}),
                            "Lines: mean and limits: three standard deviations, and half a step of the values.");
  block["marks"] = {chart.low_N_per_kN, chart.center_N_per_kN, chart.high_N_per_kN};
  return block;
}

Block make_alignment_tiles(const AlignmentResult& result) {
  constexpr std::size_t kMiddle = 1;
  const estimation::AlignedExample middle = estimation::list_aligned_examples(result)[kMiddle];
  const std::string place = fmt::format("/aligned_examples/{}/", kMiddle);
  const auto broken = std::count_if(result.checks.begin(), result.checks.end(),
                                    [](const AlignmentCheck& check) { return check.is_rule && !check.is_met; });
  return make_tiles(
      {{"Alignment",
        result.is_valid ? "valid" : "not valid",
        "",
        (broken > 0 ? format_count(static_cast<std::size_t>(broken), "rule") + " broken" : "all rules are met") +
            fmt::format("; until {}", estimation::format_day(result.valid_until_s)),
        result.is_valid ? "good" : "bad",
        {}},
       {fmt::format("Aligned value of {:.2f} N/kN measured", middle.measured_N_per_kN),
        fmt::format("{:.2f} +- {:.2f}", middle.aligned_N_per_kN, middle.expanded_of_one_N_per_kN),
        "N/kN",
        "in the middle of the alignment tires; +- is the interval of 95 % of one measurement",
        "",
        {place + "aligned_N_per_kN", place + "expanded_of_one_N_per_kN"}},
       {"Repeatability sigma_m",
        fmt::format("{:.3f}", result.sigma_m.sd),
        "N/kN",
        format_count(result.needed_measurements, "measurement") + " of each tire needed; the first of them is not used",
        "",
        {"/sigma_m_N_per_kN/value"}}});
}

/// Whether the machine is aligned, and by which line, in a sentence.
Block make_alignment_lead(const AlignmentFile& file, const AlignmentResult& result) {
  const estimation::AlignmentLine& line = result.line;
  return make_lead(
      result.is_valid ? "good" : "bad",
      fmt::format("The alignment of {} is {} until {}: the aligned RRc is {:.4f} (A1 A2) times the measured RRc "
                  "{} {:.4f} N/kN.",
                  name_or(file.machine, "the machine"), result.is_valid ? "valid" : "not valid; it would be valid",
                  estimation::format_day(result.valid_until_s), line.calc_factor(),
                  line.calc_offset() < 0.0 ? "-" : "+", std::abs(line.calc_offset())));
}

}  // namespace

std::string describe_alignment_verdict(const AlignmentResult& result) {
  std::string verdict =
      fmt::format("{} on {}", result.is_valid ? "valid" : "NOT valid", estimation::format_day(result.judged_on_s));
  if (!result.is_of_network) verdict += "; not aligned to the network (A1 and B1 are not given)";
  return verdict;
}

std::vector<Table> make_alignment_tables(const AlignmentFile& file, const AlignmentResult& result) {
  std::vector<Table> tables{make_alignment_overview(file, result), make_alignment_tire_table(file, result),
                            make_aligned_range_table(result), make_check_table(result, true),
                            make_check_table(result, false)};
  for (const Table& table : make_control_tire_tables(result)) tables.push_back(table);
  return tables;
}

std::vector<Table> make_control_tire_tables(const AlignmentResult& result) {
  std::vector<Table> tables;
  if (!result.monitoring.charts.empty()) tables.push_back(make_control_table(result));
  if (result.monitoring.drift.has_value()) tables.push_back(make_drift_table(result.monitoring));
  return tables;
}

Page make_alignment_page(const AlignmentFile& file, const AlignmentResult& result) {
  Page page{"align", fmt::format("Alignment of a machine: {}", name_or(file.machine, file.path.c_str())),
            fmt::format("{}, classes {}", format_count(file.tires.size(), "tire"), file.rules.classes)};
  Section section = make_section("Result", make_alignment_tables(file, result), result.warnings);
  put_first({make_alignment_lead(file, result), make_alignment_tiles(result), make_line_chart(result)}, section);
  page.add(std::move(section));
  page.add({"The line", "", {make_equations("align"), make_alignment_residual_chart(result)}});
  Section controls{"Control tires over time"};
  for (const ControlChart& chart : result.monitoring.charts) {
    if (chart.time_s.size() > 1) controls.blocks.push_back(make_control_chart(chart));
  }
  page.add(controls);
  page.add(make_document(estimation::make_alignment_json(file, result), "The alignment as JSON"));
  return page;
}

std::vector<Table> make_aligned_value_tables(double measured_N_per_kN, int measurements,
                                             const UncertainValue& aligned) {
  Table value{"",
              {},
              {{"measured", fmt::format("{:.3f} N/kN, {}", measured_N_per_kN,
                                        measurements == 1 ? "one measurement"
                                                          : fmt::format("mean of {} measurements", measurements))},
               {"aligned", fmt::format("{:.3f} +- {:.3f} N/kN (95 %, k = {:.2f})", aligned.value,
                                       aligned.coverage_factor * aligned.sd, aligned.coverage_factor)}}};
  Table budget{"Uncertainty", {"contribution", "u N/kN", "degrees of freedom", "share of u2 %"}, {}};
  for (const estimation::AlignedContribution& one : aligned.contributions) {
    const double share = aligned.sd > 0.0 ? 100.0 * one.sd * one.sd / (aligned.sd * aligned.sd) : 0.0;
    budget.rows.push_back({one.name, fmt::format("{:.4f}", one.sd), fmt::format("{:.0f}", one.degrees_of_freedom),
                           fmt::format("{:.1f}", share)});
  }
  budget.rows.push_back(
      {"combined", fmt::format("{:.4f}", aligned.sd), fmt::format("{:.0f}", aligned.degrees_of_freedom), "100.0"});
  return {value, budget};
}

}  // namespace rollrig::report
