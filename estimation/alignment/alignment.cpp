#include "estimation/alignment/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "estimation/alignment/alignment_doubts.h"
#include "measurements/logs/time_stamps.h"
#include "sim/core/error.h"
#include "sim/core/limits.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

constexpr const char* kSection1 = "EU 2020/740 Annex V, 1(4) and 5";
constexpr const char* kSection2 = "EU 2020/740 Annex V, 2.2; second-hand";
constexpr const char* kSection5 = "EU 2020/740 Annex V, 5";
constexpr const char* kSection3 = "EU 2020/740 Annex V, 3; second-hand";
constexpr const char* kLargestResidual = "largest residual";
constexpr double kMostBend_N_per_kN = 0.02;  // Assumed: a fifth of the 0.1 N/kN to which a label is rounded
constexpr double kMostScatter_N_per_kN = 0.1;  // Assumed: of tires about a line; a label is rounded to it
// Assumed: scaled residual of a tire, or exchanged values; where tires scatter by up to kMostScatter, evenly spread, 1
// of 200 alignments has more
constexpr double kLeastMistake_N_per_kN = 2.7 * kMostScatter_N_per_kN;
constexpr double kNoLineLevel = 0.001;         // Assumed: of significance of such scatter
constexpr double kMostChange = 0.2;            // Assumed: of a value, by a line between two machines

std::vector<std::vector<double>> list_groups(const AlignmentFile& file, TireMeasurements AlignmentTire::*side) {
  std::vector<std::vector<double>> groups;
  for (const AlignmentTire& tire : file.tires) groups.push_back((tire.*side).used());
  return groups;
}

/// Standard deviation of a mean of that many values, by the mean of 1/n over the tires. Rounding errors larger than the
/// scatter are alike in all values of a tire, so that a mean has them whole.
double calc_sd_of_mean(double sd, const std::vector<std::vector<double>>& groups, double step) {
  double inverse = 0.0;
  for (const std::vector<double>& group : groups) inverse += 1.0 / static_cast<double>(group.size());
  return std::max(sd * std::sqrt(inverse / static_cast<double>(groups.size())), calc_rounding_sd(step));
}

/// A tire that the line of the others does not describe.
std::string describe_outlier(const AlignmentFile& file, const LineFit& fit, const LineOutlier& outlier) {
  const LinePoint& point = fit.points[outlier.place];
  return fmt::format(
      "tire '{}' does not fit the line of the other tires: by it, {:.2f} N/kN is {:.2f} N/kN on the reference machine, "
      "which has {:.2f} N/kN (p = {:.1g}). Is a value of it typed wrong, or was the tire exchanged or damaged?",
      file.tires[outlier.place].name, point.x, outlier.by_others_y, point.y, outlier.p_value);
}

std::string describe_exchange(const AlignmentFile& file, const LineFit& fit, const LineExchange& exchange) {
  return fmt::format(
      "tires '{}' and '{}' look exchanged on one of the machines: with their values exchanged, the line describes all "
      "tires (p = {:.2g} instead of {:.1g})",
      file.tires[exchange.first].name, file.tires[exchange.second].name, exchange.lack_of_fit_p, fit.lack_of_fit_p);
}

/// Empty where there is none.
std::string describe_mistake(const AlignmentFile& file, const AlignmentResult& result) {
  const LineMistake& mistake = result.mistake;
  if (mistake.exchange.has_value()) return describe_exchange(file, result.fit, *mistake.exchange);
  return mistake.outlier.has_value() ? describe_outlier(file, result.fit, *mistake.outlier) : "";
}

/// The same behind another sentence; empty where there is none.
std::string mention_mistake(const AlignmentFile& file, const AlignmentResult& result) {
  std::string text = describe_mistake(file, result);
  if (text.empty()) return "";
  text.front() = 'T';
  return ". " + text;
}

bool are_equal(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&values](double value) { return value == values.front(); });
}

void fit_machines(const AlignmentFile& file, AlignmentResult& result) {
  std::vector<double> x, y;
  for (const AlignmentTire& tire : file.tires) {
    x.push_back(tire.candidate.mean());
    y.push_back(tire.reference_N_per_kN);
  }
  const double step = find_candidate_step(file), reference_step = find_reference_step(file);
  const auto candidate = list_groups(file, &AlignmentTire::candidate);
  const ScatterEstimate of_candidate = pool_repeats(candidate);
  result.sigma_m = add_rounding(of_candidate, step);
  RepeatScatter repeats{calc_sd_of_mean(of_candidate.sd, candidate, step), calc_rounding_sd(reference_step),
                        of_candidate.degrees_of_freedom};
  result.plain_repeats = {calc_sd_of_mean(of_candidate.sd, candidate, 0.0), 0.0, of_candidate.degrees_of_freedom};
  if (!file.reference_machine.empty()) {
    const auto reference = list_groups(file, &AlignmentTire::reference);
    const ScatterEstimate of_reference = pool_repeats(reference);
    result.sigma_l = add_rounding(of_reference, reference_step);
    repeats.reference_sd = calc_sd_of_mean(of_reference.sd, reference, reference_step);
    result.plain_repeats.reference_sd = calc_sd_of_mean(of_reference.sd, reference, 0.0);
    repeats.degrees_of_freedom += of_reference.degrees_of_freedom;
    result.plain_repeats.degrees_of_freedom = repeats.degrees_of_freedom;
  }
  if (!(x.back() > x.front())) {
    throw InputError({"all tires have one measured value", file.path, 0, "tire", fmt::format("{:g} N/kN", x.front()),
                      "tires of different rolling resistance", ""});
  }
  if (are_equal(y)) {
    throw InputError({"all tires have one reference value", file.path, 0, "tire", fmt::format("{:g} N/kN", y.front()),
                      "the reference value of each tire: tires of different rolling resistance have different ones",
                      ""});
  }
  result.fit = fit_line(x, y, repeats);
  const bool are_both_repeated = result.sigma_l.has_value();
  result.mistake =
      find_line_mistake(result.fit, are_both_repeated ? repeats : RepeatScatter{}, kLeastMistake_N_per_kN);
  if (result.fit.slope > 0.0) return;
  throw InputError({fmt::format("the two machines order the tires the other way round (A2 = {:.3f}){}", result.fit.slope,
                                mention_mistake(file, result)),
                    file.path, 0, "", "",
                    "values of the reference that rise with the measured ones: are names of tires "
                    "exchanged?",
                    ""});
}

AlignmentLine make_line(const AlignmentResult& result, const AlignmentInput& input) {
  AlignmentLine line = make_alignment_line(result.fit, result.sigma_m,
                                           result.sigma_l.has_value() ? result.sigma_l->degrees_of_freedom
                                                                      : std::numeric_limits<double>::infinity());
  if (input.reference.has_value()) std::tie(line.A1, line.B1) = *input.reference;
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

/// The rounding of the reference values alone may not be as large as the scatter that a reference machine may have.
void add_rounding_rule(const AlignmentFile& file, AlignmentResult& result) {
  const double step = find_reference_step(file), most = file.rules.reference_sigma_N_per_kN;
  const double rounding_sd = calc_rounding_sd(step);
  result.checks.push_back({"rounding of the reference values",
                           fmt::format("steps of {:g} N/kN, u = {:.3f} N/kN", step, rounding_sd),
                           fmt::format("u <= {:g} N/kN, as sigma_m of a reference machine", most),
                           "EU 2020/740 Annex V, 3; second-hand, for rounding Assumed", is_at_most(rounding_sd, most)});
  constexpr double kSmallShare = 1.0 / 3.0;  // Assumed: adds 5 % to a standard deviation of the limit
  if (!file.reference_machine.empty() || is_at_most(rounding_sd, kSmallShare * most)) return;
  result.warnings.push_back(
      fmt::format("the reference values have steps of {:g} N/kN, a standard uncertainty of {:.3f} N/kN: state more "
                  "digits",
                  step, rounding_sd));
}

void add_rules(const AlignmentFile& file, AlignmentResult& result) {
  const AlignmentRules& rules = file.rules;
  const double range = calc_range(result);
  result.checks.push_back({"alignment tires", fmt::format("{}", file.tires.size()),
                           fmt::format(">= {}", rules.least_tires), kSection1, file.tires.size() >= rules.least_tires,
                           true, true});
  result.checks.push_back({"range of RRc, before and after", fmt::format("{:.2f} N/kN", range),
                           fmt::format(">= {:g} N/kN ({})", rules.least_range_N_per_kN, rules.classes), kSection2,
                           is_at_least(range, rules.least_range_N_per_kN), true, true});
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
  add_rounding_rule(file, result);
  result.needed_measurements = calc_measurements(rules, result.sigma_m.sd);
  const bool is_repeatable = is_at_most(result.sigma_m.sd, rules.sigma_m_N_per_kN);
  const bool has_enough = kept + 1 >= result.needed_measurements;
  result.checks.push_back(
      {"sigma_m", fmt::format("{:.3f} N/kN", result.sigma_m.sd),
       fmt::format("<= {:g} N/kN, or {} measurements of each tire", rules.sigma_m_N_per_kN, result.needed_measurements),
       kSection5, is_repeatable || has_enough});
  const LineFit& fit = result.fit;
  const bool is_line =
      is_at_least(fit.lack_of_fit_p, kNoLineLevel) || is_at_most(fit.residual_sd, kMostScatter_N_per_kN);
  result.checks.push_back({"the line describes the tires",
                           fmt::format("{:.3f} N/kN about it, by repeats {:.3f} (p = {})", fit.residual_sd,
                                       fit.repeat_sd, format_p_value(fit.lack_of_fit_p, kNoLineLevel)),
                           fmt::format("<= {:g} N/kN, or p >= {:g}", kMostScatter_N_per_kN, kNoLineLevel),
                           "statistics; Assumed", is_line});
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

/// Refuses what is no alignment. A tire that does not fit, or two that are exchanged, change the slope, and so the range.
void require_rules(const AlignmentFile& file, const AlignmentResult& result) {
  for (const AlignmentCheck& check : result.checks) {
    if (check.is_met || !check.stops_fit) continue;
    throw InputError({fmt::format("these measurements do not make an alignment: {}{}", check.name,
                                  mention_mistake(file, result)),
                      file.path, 0, "", check.found,
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
         level, is_at_least(fit.lack_of_fit_p, kLevel));
  const auto weigh = [](const LinePoint& point) {
    return std::abs(std::isfinite(point.studentized) ? point.studentized : point.residual);
  };
  const auto worst =
      std::max_element(fit.points.begin(), fit.points.end(),
                       [&weigh](const LinePoint& a, const LinePoint& b) { return weigh(a) < weigh(b); });
  const std::size_t index = static_cast<std::size_t>(worst - fit.points.begin());
  advise(kLargestResidual,
         fmt::format("tire '{}': {:+.3f} N/kN (p = {})", file.tires[index].name, worst->residual,
                     format_p_value(worst->p_value, kLevel)),
         level, is_at_least(worst->p_value, kLevel));
  if (result.sigma_l.has_value()) {
    const ScatterEstimate& sigma_l = *result.sigma_l;
    result.checks.push_back({"sigma_m of the reference machine",
                             fmt::format("{:.3f} N/kN ({:.3f} to {:.3f})", sigma_l.sd, sigma_l.low_95, sigma_l.high_95),
                             fmt::format("<= {:g} N/kN, or within the interval", file.rules.reference_sigma_N_per_kN),
                             kSection3, is_at_most(sigma_l.low_95, file.rules.reference_sigma_N_per_kN), false});
  }
  const auto far = std::max_element(fit.points.begin(), fit.points.end(),
                                    [](const auto& a, const auto& b) { return a.leverage < b.leverage; });
  advise("largest leverage",
         fmt::format("tire '{}': {:.2f}", file.tires[static_cast<std::size_t>(far - fit.points.begin())].name,
                     far->leverage),
         fmt::format("<= {:.2f}, twice the mean", 4.0 / p), is_at_most(far->leverage, 4.0 / p));
  const double bend = fit.attenuation * fit.slope * 0.5 * (fit.points.back().x - fit.points.front().x);
  advise("bias of A2 by errors of the measured values",
         fmt::format("{:.2f} %, {:.3f} N/kN at the ends", -100.0 * fit.attenuation, bend),
         fmt::format("<= {:g} N/kN", kMostBend_N_per_kN), is_at_most(bend, kMostBend_N_per_kN));
}

double calc_days_since(const ControlChart& chart, double day_s) {
  return std::floor(day_s / measurements::kDay_s) - std::floor(chart.time_s.back() / measurements::kDay_s);
}

std::string describe_shift(const ControlShift& shift) {
  return fmt::format("shifted by {:+.3f} N/kN from {} on", shift.by_N_per_kN, format_day(shift.from_s));
}

/// What is not in control in a chart.
std::string describe_out_of_control(const ControlChart& chart) {
  if (chart.shift.has_value()) return "the mean has " + describe_shift(*chart.shift);
  if (chart.outside.empty()) {
    return fmt::format("{} measurements in a row on one side of their mean; measure it again", chart.longest_run);
  }
  return fmt::format("{} beyond the limits of three standard deviations, the first on {}",
                     format_count(chart.outside.size(), "measurement"),
                     format_day(chart.time_s[chart.outside.front()]));
}

/// `where`: the machine, in the words of the warning.
void add_chart_warnings(const ControlMonitoring& monitoring, const std::string& where,
                        std::vector<std::string>& warnings) {
  for (const ControlChart& chart : monitoring.charts) {
    if (!is_out_of_control(chart)) continue;
    warnings.push_back(fmt::format("control tire '{}'{}: {}", chart.tire, where, describe_out_of_control(chart)));
  }
}

/// Of what has_drift() finds.
std::string describe_drift(const ControlMonitoring& monitoring) {
  if (monitoring.shift.has_value()) return "have " + describe_shift(*monitoring.shift);
  const ControlDrift& drift = *monitoring.drift;
  return fmt::format("drift by {:+.3f} N/kN a year ({:+.3f} to {:+.3f})", drift.N_per_kN_per_year, drift.low_95,
                     drift.high_95);
}

/// The reference machine's own: whether it holds is its laboratory's to judge.
void add_reference_monitoring(const AlignmentFile& file, AlignmentResult& result) {
  result.reference_monitoring = watch_control_tires(file.reference_controls);
  const std::string where = fmt::format(" on the reference machine '{}'", file.reference_machine);
  add_chart_warnings(result.reference_monitoring, where, result.warnings);
  if (!has_drift(result.reference_monitoring)) return;
  result.warnings.push_back(
      fmt::format("the control tires{} {}: ask its laboratory whether its values still hold", where,
                  describe_drift(result.reference_monitoring)));
}

/// Rows that no machine of the alignment has.
void add_unused_rows(const AlignmentFile& file, std::vector<std::string>& warnings) {
  for (const UnusedRows& unused : file.unused) {
    const std::string nearest = nearest_name(unused.machine, {file.machine, file.reference_machine});
    warnings.push_back(fmt::format(
        "{} of machine '{}' {} not used, {} of a control tire: line {}{}", format_count(unused.lines.size(), "row"),
        unused.machine, unused.lines.size() == 1 ? "is" : "are", unused.controls, fmt::join(unused.lines, ", "),
        nearest.empty() ? "" : fmt::format(". Is the machine '{}'?", nearest)));
  }
}

void add_monitoring(const AlignmentFile& file, AlignmentResult& result) {
  for (const ControlChart& chart : result.monitoring.charts) {
    const double gap_days = std::max(chart.largest_gap_days, calc_days_since(chart, result.judged_on_s));
    result.checks.push_back({fmt::format("control tire '{}': days between measurements", chart.tire),
                             fmt::format("{:.0f} at most, until {}", gap_days, format_day(result.judged_on_s)),
                             fmt::format("<= {:g}", kMostControlDays), "UN R117 Annex 6; second-hand",
                             is_at_most(gap_days, kMostControlDays), false});
    if (chart.rrc_N_per_kN.size() < kLeastControlMeasurements) {
      result.warnings.push_back(fmt::format("control tire '{}' has {}: too few for limits of its own", chart.tire,
                                            format_count(chart.rrc_N_per_kN.size(), "measurement")));
    } else if (are_equal(chart.rrc_N_per_kN)) {
      result.warnings.push_back(describe_equal_values(
          fmt::format("the {} values of control tire '{}'", chart.rrc_N_per_kN.size(), chart.tire),
          list_candidate_values(file)));
    }
  }
  add_chart_warnings(result.monitoring, "", result.warnings);
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
  const double earliest_s = std::max(file.last_s, file.complete_s);
  result.judged_on_s =
      input.on.empty() ? std::max({file.newest_s, earliest_s, changed_s}) : read_day_s(input.on, "--on");
  if (format_day(result.judged_on_s) < format_day(earliest_s)) {
    throw InputError({"validity is judged on a day before the last measurement of the alignment", "command line", 0,
                      "--on", input.on, fmt::format("{} or later", format_day(earliest_s)), ""});
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
    result.due_because.push_back("the control tires " + describe_drift(result.monitoring));
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

/// A line between two machines that changes a value by more than machines differ.
std::optional<std::string> doubt_line(const char* A, const char* B, double slope, double offset, double low,
                                      double high) {
  const auto calc_change = [&](double value) { return (slope * value + offset) / value - 1.0; };
  const double most = std::max({std::abs(slope - 1.0), std::abs(calc_change(low)), std::abs(calc_change(high))});
  if (is_at_most(most, kMostChange)) return std::nullopt;
  return fmt::format(
      "{} = {:.3f} and {} = {:.3f} N/kN change RRc by {:+.0f} % at {:.2f} N/kN and by {:+.0f} % at {:.2f} N/kN; "
      "machines seldom differ by more than {:.0f} %: are both values corrected to 25 degC and the 2 m drum, and in one "
      "unit?",
      A, slope, B, offset, 100.0 * calc_change(low), low, 100.0 * calc_change(high), high, 100.0 * kMostChange);
}

void add_line_warnings(const AlignmentFile& file, AlignmentResult& result) {
  const std::string mistake = describe_mistake(file, result);
  if (!mistake.empty()) result.warnings.push_back(mistake);
  if (!result.is_of_network) {
    result.warnings.push_back(
        "A1 and B1 of the reference laboratory are not given (--reference): the result is aligned "
        "to its machine, not to the network");
  }
  const LineFit& fit = result.fit;
  const double low = fit.points.front().x, high = fit.points.back().x;
  for (const auto& doubt :
       {doubt_line("A2", "B2", result.line.A2, result.line.B2, low, high),
        doubt_line("A1", "B1", result.line.A1, result.line.B1, fit.value(low), fit.value(high))}) {
    if (doubt.has_value()) result.warnings.push_back(*doubt);
  }
  for (const AlignmentCheck& check : result.checks) {
    const bool is_said = !mistake.empty() && check.name == kLargestResidual;
    if (!check.is_met && !check.is_rule && !is_said) {
      result.warnings.push_back(fmt::format("{}: {}; expected {}", check.name, check.found, check.limit));
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
  if (!input.preliminary) require_rules(file, result);
  add_advice(file, result);
  result.monitoring = watch_control_tires(file.controls);
  judge_validity(file, input, result);
  add_monitoring(file, result);
  add_reference_monitoring(file, result);
  add_unused_rows(file, result.warnings);
  add_line_warnings(file, result);
  for (const std::string& doubt : list_value_doubts(file)) result.warnings.push_back(doubt);
  for (const std::string& doubt : list_line_doubts(file, result.fit, result.plain_repeats)) {
    result.warnings.push_back(doubt);
  }
  for (const std::string& doubt : list_time_doubts(file)) result.warnings.push_back(doubt);
  return result;
}

}  // namespace rollrig::estimation
