#include "estimation/alignment/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "estimation/alignment/alignment_doubts.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

constexpr const char* kSection1 = "EU 2020/740 Annex V, 1(4) and 5";
constexpr const char* kSection2 = "EU 2020/740 Annex V, 2.2; second-hand";
constexpr const char* kSection5 = "EU 2020/740 Annex V, 5";
constexpr double kMostBend_N_per_kN = 0.02;  // Assumed: a fifth of the 0.1 N/kN to which a label is rounded

std::vector<std::vector<double>> list_groups(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::vector<std::vector<double>> groups;
  for (const AlignmentTire& tire : file.tires) groups.push_back((tire.*side).used());
  return groups;
}

/// Standard deviation of a mean of that many values, by the mean of 1/n over the tires.
double calc_sd_of_mean(double sd, const std::vector<std::vector<double>>& groups) {
  double inverse = 0.0;
  for (const std::vector<double>& group : groups) inverse += 1.0 / static_cast<double>(group.size());
  return sd * std::sqrt(inverse / static_cast<double>(groups.size()));
}

void fit_machines(const AlignmentFile& file, AlignmentResult& result) {
  std::vector<double> x, y;
  for (const AlignmentTire& tire : file.tires) {
    x.push_back(tire.candidate.mean());
    y.push_back(tire.reference_N_per_kN);
  }
  const auto candidate = list_groups(file, &AlignmentTire::candidate);
  result.sigma_m = pool_repeats(candidate);
  RepeatScatter repeats{calc_sd_of_mean(result.sigma_m.sd, candidate), 0.0, result.sigma_m.degrees_of_freedom};
  if (!file.reference_machine.empty()) {
    const auto reference = list_groups(file, &AlignmentTire::reference);
    result.sigma_l = pool_repeats(reference);
    repeats.reference_sd = calc_sd_of_mean(result.sigma_l->sd, reference);
    repeats.degrees_of_freedom += result.sigma_l->degrees_of_freedom;
  }
  if (!(x.back() > x.front())) {
    throw InputError({"all tires have one measured value", file.path, 0, "tire", fmt::format("{:g} N/kN", x.front()),
                      "tires of different rolling resistance", ""});
  }
  result.fit = fit_line(x, y, repeats);
  if (result.fit.slope > 0.0) return;
  throw InputError({fmt::format("the two machines order the tires the other way round (A2 = {:.3f})", result.fit.slope),
                    file.path, 0, "", "",
                    "values of the reference that rise with the measured ones: are names of tires "
                    "exchanged?",
                    ""});
}

AlignmentLine make_line(const AlignmentResult& result, const AlignmentInput& input) {
  const LineFit& fit = result.fit;
  const double p = static_cast<double>(fit.points.size());
  AlignmentLine line;
  if (input.reference.has_value()) std::tie(line.A1, line.B1) = *input.reference;
  line.A2 = fit.slope;
  line.B2 = fit.offset;
  line.tires = p;
  line.mean_x = fit.mean_x;
  line.Sxx = fit.Sxx;
  line.line_sd = fit.sd;
  line.line_freedom = fit.freedom;
  line.between_sd = fit.between_sd;
  line.between_freedom = p - 2.0;
  line.sigma_m = result.sigma_m.sd;
  line.sigma_m_freedom = result.sigma_m.degrees_of_freedom;
  return line;
}

/// The smaller of the ranges before and after the alignment.
double calc_range(const AlignmentResult& result) {
  const double measured = result.fit.points.back().x - result.fit.points.front().x;
  return measured * std::min(1.0, result.line.A1 * result.line.A2);
}

std::size_t count_fewest(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const AlignmentTire& tire : file.tires) fewest = std::min(fewest, (tire.*side).used().size());
  return fewest;
}

void add_rules(const AlignmentFile& file, AlignmentResult& result) {
  const AlignmentRules& rules = file.rules;
  const double range = calc_range(result);
  result.checks.push_back({"alignment tires", fmt::format("{}", file.tires.size()),
                           fmt::format(">= {}", rules.least_tires), kSection1, file.tires.size() >= rules.least_tires,
                           true, true});
  result.checks.push_back({"range of RRC, before and after", fmt::format("{:.2f} N/kN", range),
                           fmt::format(">= {:g} N/kN ({})", rules.least_range_N_per_kN, rules.classes), kSection2,
                           range >= rules.least_range_N_per_kN, true, true});
  const std::size_t kept = count_fewest(file, &AlignmentTire::candidate);
  result.checks.push_back({"measurements of each tire that are used", fmt::format("{}", kept),
                           fmt::format(">= {}, after the first", rules.measurements - 1), kSection5,
                           kept >= rules.measurements - 1, true, true});
  if (result.sigma_l.has_value()) {
    const std::size_t of_reference = count_fewest(file, &AlignmentTire::reference);
    result.checks.push_back({"measurements of each tire, reference machine", fmt::format("{}", of_reference),
                             fmt::format(">= {}, after the first", rules.measurements - 1), kSection5,
                             of_reference >= rules.measurements - 1, true, true});
  }
  result.needed_measurements = calc_measurements(rules, result.sigma_m.sd);
  const bool is_repeatable = result.sigma_m.sd <= rules.sigma_m_N_per_kN;
  const bool has_enough = kept + 1 >= result.needed_measurements;
  result.checks.push_back(
      {"sigma_m", fmt::format("{:.3f} N/kN", result.sigma_m.sd),
       fmt::format("<= {:g} N/kN, or {} measurements of each tire", rules.sigma_m_N_per_kN, result.needed_measurements),
       kSection5, is_repeatable || has_enough});
  if (!file.reference_machine.empty()) {
    double first_of_reference_s = std::numeric_limits<double>::infinity();
    for (const AlignmentTire& tire : file.tires) {
      first_of_reference_s = std::min(first_of_reference_s, tire.reference.all.front().time_s);
    }
    result.checks.push_back({"candidate before reference",
                             first_of_reference_s >= file.last_s ? "yes" : "the reference measured before the end",
                             "first the candidate, then the reference", kSection5,
                             first_of_reference_s >= file.last_s});
  }
}

/// Refuses what is no alignment.
void require_rules(const AlignmentFile& file, const std::vector<AlignmentCheck>& checks) {
  for (const AlignmentCheck& check : checks) {
    if (check.is_met || !check.stops_fit) continue;
    throw InputError({fmt::format("these measurements do not make an alignment: {}", check.name), file.path, 0, "",
                      check.found,
                      fmt::format("{} ({}); --preliminary to compute it all the same", check.limit, check.source), ""});
  }
}

void add_advice(const AlignmentFile& file, AlignmentResult& result) {
  const LineFit& fit = result.fit;
  const double p = static_cast<double>(fit.points.size());
  constexpr double kLevel = 0.05;  // Assumed: of significance
  const std::string level = fmt::format("p >= {:g}", kLevel);
  const auto advise = [&result](const std::string& name, const std::string& found, const std::string& limit,
                                bool is_met) {
    result.checks.push_back({name, found, limit, "statistics; Assumed", is_met, false});
  };
  advise("scatter of tires about the line",
         fmt::format("{:.3f} N/kN, by repeats {:.3f} (p = {})", fit.residual_sd, fit.repeat_sd,
                     format_p_value(fit.lack_of_fit_p, kLevel)),
         level, fit.lack_of_fit_p >= kLevel);
  const auto worst = std::max_element(fit.points.begin(), fit.points.end(),
                                      [](const auto& a, const auto& b) { return a.p_value > b.p_value; });
  const std::size_t index = static_cast<std::size_t>(worst - fit.points.begin());
  advise("largest residual",
         fmt::format("tire '{}': {:+.3f} N/kN (p = {})", file.tires[index].name, worst->residual,
                     format_p_value(worst->p_value, kLevel)),
         level, worst->p_value >= kLevel);
  const auto far = std::max_element(fit.points.begin(), fit.points.end(),
                                    [](const auto& a, const auto& b) { return a.leverage < b.leverage; });
  advise("largest leverage",
         fmt::format("tire '{}': {:.2f}", file.tires[static_cast<std::size_t>(far - fit.points.begin())].name,
                     far->leverage),
         fmt::format("<= {:.2f}, twice the mean", 4.0 / p), far->leverage <= 4.0 / p);
  const double bend = fit.attenuation * fit.slope * 0.5 * (fit.points.back().x - fit.points.front().x);
  advise("bias of A2 by errors of the measured values",
         fmt::format("{:.2f} %, {:.3f} N/kN at the ends", -100.0 * fit.attenuation, bend),
         fmt::format("<= {:g} N/kN", kMostBend_N_per_kN), bend <= kMostBend_N_per_kN);
}

void add_monitoring(const AlignmentFile& file, AlignmentResult& result) {
  for (const ControlChart& chart : result.monitoring.charts) {
    result.checks.push_back({fmt::format("control tire '{}': days between measurements", chart.tire),
                             fmt::format("{:.0f} at most", chart.largest_gap_days),
                             fmt::format("<= {:g}", kMostControlDays), "UN R117 Annex 6; second-hand",
                             chart.largest_gap_days <= kMostControlDays, false});
    if (chart.rrc_N_per_kN.size() < kLeastControlMeasurements) {
      result.warnings.push_back(fmt::format("control tire '{}' has {}: too few for limits of its own", chart.tire,
                                            format_count(chart.rrc_N_per_kN.size(), "measurement")));
    }
  }
  for (const ControlChart& chart : result.monitoring.charts) {
    if (!is_out_of_control(chart)) continue;
    result.warnings.push_back(
        chart.outside.empty()
            ? fmt::format("control tire '{}': {} measurements in a row on one side of their mean; measure it again",
                          chart.tire, chart.longest_run)
            : fmt::format("control tire '{}': {} beyond three standard deviations, the first on {}", chart.tire,
                          format_count(chart.outside.size(), "measurement"),
                          format_day(chart.time_s[chart.outside.front()])));
  }
  if (file.controls.empty()) {
    result.warnings.push_back("no control tire (use = control): whether the machine drifts is not known");
  }
}

/// When the machine has to be aligned anew.
void judge_validity(const AlignmentFile& file, const AlignmentInput& input, AlignmentResult& result) {
  result.valid_until_s = add_years(file.last_s, file.rules.years_valid);
  constexpr double kNever_s = -std::numeric_limits<double>::infinity();
  const double changed_s =
      input.machine_changed.empty() ? kNever_s : read_day_s(input.machine_changed, "--machine-changed");
  result.judged_on_s = input.on.empty() ? std::max(file.newest_s, changed_s) : read_day_s(input.on, "--on");
  if (format_day(result.judged_on_s) < format_day(file.last_s)) {
    throw InputError({"validity is judged on a day before the last measurement of the alignment", "command line", 0,
                      "--on", input.on, fmt::format("{} or later", format_day(file.last_s)), ""});
  }
  if (result.judged_on_s > result.valid_until_s) {
    result.due_because.push_back(fmt::format("the alignment was valid until {}", format_day(result.valid_until_s)));
  }
  if (changed_s >= file.first_s && changed_s <= result.judged_on_s) {
    result.due_because.push_back(
        fmt::format("the machine was changed on {}, after the first measurement of the "
                    "alignment",
                    input.machine_changed));
  }
  if (has_drift(result.monitoring)) {
    const ControlDrift& drift = *result.monitoring.drift;
    result.due_because.push_back(fmt::format("the control tires drift by {:+.3f} N/kN a year ({:+.3f} to {:+.3f})",
                                             drift.N_per_kN_per_year, drift.low_95, drift.high_95));
  }
  result.is_valid = result.due_because.empty() &&
                    std::all_of(result.checks.begin(), result.checks.end(),
                                [](const AlignmentCheck& check) { return check.is_met || !check.is_rule; });
}

void require_reference_line(double A1, double B1_N_per_kN) {
  // Assumed: far beyond the lines of reference laboratories, which are near 1 and 0
  constexpr double kLeastSlope = 0.5, kMostSlope = 2.0, kMostOffset_N_per_kN = 5.0;
  if (A1 >= kLeastSlope && A1 <= kMostSlope && std::abs(B1_N_per_kN) <= kMostOffset_N_per_kN) return;
  throw InputError({"A1 and B1 are not plausible for a reference laboratory", "command line", 0, "--reference",
                    fmt::format("{:g} {:g}", A1, B1_N_per_kN),
                    fmt::format("A1 near 1, {:g} to {:g}, and B1 near 0 N/kN, {:g} to {:g}", kLeastSlope, kMostSlope,
                                -kMostOffset_N_per_kN, kMostOffset_N_per_kN),
                    ""});
}

void add_line_warnings(AlignmentResult& result) {
  if (!result.is_of_network) {
    result.warnings.push_back(
        "A1 and B1 of the reference laboratory are not given (--reference): the result is aligned "
        "to its machine, not to the network");
  }
  constexpr double kLeastScatter_N_per_kN = 1e-6;  // Assumed: far below any resolution; means of equal values round
  if (result.sigma_m.sd <= kLeastScatter_N_per_kN) {
    result.warnings.push_back("all measurements of each tire are equal: real measurements scatter. Were they copied?");
  }
  if (std::abs(result.line.A2 - 1.0) > 0.2) {
    result.warnings.push_back(
        fmt::format("A2 = {:.3f} is far from 1: are both values corrected to 25 degC and the 2 m "
                    "drum, and in one unit?",
                    result.line.A2));
  }
  for (const AlignmentCheck& check : result.checks) {
    if (!check.is_met && !check.is_rule) {
      result.warnings.push_back(fmt::format("{}: {} ({})", check.name, check.found, check.limit));
    }
  }
}

}  // namespace

std::string format_p_value(double p, double level) {
  constexpr int kFewestDigits = 2, kMostDigits = 17;
  std::string text;
  for (int digits = kFewestDigits; digits <= kMostDigits; ++digits) {
    text = fmt::format("{:#.{}g}", p, digits);
    if ((parse_number(text).value_or(p) < level) == (p < level)) break;
  }
  return text;
}

AlignmentResult align_machine(const AlignmentFile& file, const AlignmentInput& input) {
  if (file.is_assigned && input.reference.has_value()) {
    throw InputError(
        {"assigned values of the network are aligned already", "command line", 0, "--reference", "",
         fmt::format("no --reference, or a column {} with values of the reference laboratory", kReferenceColumn), ""});
  }
  if (input.reference.has_value()) require_reference_line(input.reference->first, input.reference->second);
  if (file.tires.size() < 3) {
    throw InputError(
        {"too few alignment tires", file.path, 0, "tire", format_count(file.tires.size(), "tire"),
         fmt::format("at least {} ({}); three at the very least, for a line", file.rules.least_tires, kSection1), ""});
  }
  AlignmentResult result;
  fit_machines(file, result);
  result.line = make_line(result, input);
  result.is_of_network = input.reference.has_value() || file.is_assigned;
  add_rules(file, result);
  if (!input.preliminary) require_rules(file, result.checks);
  add_advice(file, result);
  result.monitoring = watch_control_tires(file.controls);
  add_monitoring(file, result);
  judge_validity(file, input, result);
  add_line_warnings(result);
  for (const std::string& doubt : list_value_doubts(file)) result.warnings.push_back(doubt);
  return result;
}

}  // namespace rollrig::estimation
