#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/alignment/alignment.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/parse_json.h"

namespace rollrig::estimation {
namespace {

constexpr const char* kAlignmentFormat = "rollrig-alignment/1";

Json alignment_json(const ScatterEstimate& scatter) {
  return {{"value", scatter.sd},
          {"degrees_of_freedom", scatter.degrees_of_freedom},
          {"ci95", {scatter.low_95, scatter.high_95}}};
}

Json make_tire_json(const AlignmentTire& tire, const LinePoint& point) {
  Json json = {{"tire", tire.name},
               {"class", tire.tire_class},
               {"measurements", tire.candidate.all.size()},
               {"used", tire.candidate.used().size()},
               {"measured_N_per_kN", point.x},
               {"reference_N_per_kN", point.y},
               {"residual_N_per_kN", point.residual},
               {"leverage", point.leverage}};
  json["studentized_residual"] = std::isfinite(point.studentized) ? Json(point.studentized) : Json();
  return json;
}

Json make_line_json(const LineFit& fit, const AlignmentLine& line) {
  const double k = fit.coverage_factor();
  const auto estimate = [k](double value, double sd) {
    return Json{{"value", value}, {"sd", sd}, {"ci95", {value - k * sd, value + k * sd}}};
  };
  return {{"A2", estimate(fit.slope, fit.slope_sd())},
          {"B2_N_per_kN", estimate(fit.offset, fit.offset_sd())},
          {"tires", fit.points.size()},
          {"mean_measured_N_per_kN", fit.mean_x},
          {"Sxx_N2_per_kN2", fit.Sxx},
          {"line_sd_N_per_kN", fit.sd},
          {"line_degrees_of_freedom", fit.freedom},
          {"residual_sd_N_per_kN", fit.residual_sd},
          {"repeat_sd_N_per_kN", fit.repeat_sd},
          {"between_tires_sd_N_per_kN", fit.between_sd},
          {"candidate_mean_sd_N_per_kN", line.candidate_sd},
          {"rest_sd_N_per_kN", line.rest_sd},
          {"rest_degrees_of_freedom", std::isfinite(line.rest_freedom) ? Json(line.rest_freedom) : Json()},
          {"lack_of_fit_p", fit.lack_of_fit_p},
          {"attenuation", fit.attenuation}};
}

Json make_shift_json(const ControlShift& shift) {
  return {{"from", format_day(shift.from_s)}, {"by_N_per_kN", shift.by_N_per_kN}};
}

Json alignment_json(const ControlChart& chart) {
  Json json = {{"tire", chart.tire},
               {"measurements", chart.rrc_N_per_kN.size()},
               {"center_N_per_kN", chart.center_N_per_kN},
               {"sd_N_per_kN", chart.sd_N_per_kN},
               {"limits_N_per_kN", {chart.low_N_per_kN, chart.high_N_per_kN}},
               {"last_measurement", format_day(chart.time_s.back())},
               {"longest_run_on_one_side", chart.longest_run},
               {"largest_gap_days", chart.largest_gap_days}};
  if (chart.shift.has_value()) json["shift"] = make_shift_json(*chart.shift);
  json["outside"] = make_list(chart.outside, [&chart](std::size_t i) {
    return Json{{"date", format_day(chart.time_s[i])}, {"rrc_N_per_kN", chart.rrc_N_per_kN[i]}};
  });
  return json;
}

Json make_monitoring_json(const ControlMonitoring& monitoring) {
  Json json = {
      {"tires", make_list(monitoring.charts, [](const ControlChart& chart) { return alignment_json(chart); })}};
  if (monitoring.shift.has_value()) {
    json["shift"] = make_shift_json(*monitoring.shift);
    json["shift"]["p"] = monitoring.shift->p_value;
  }
  if (!monitoring.drift.has_value()) return json;
  const ControlDrift& drift = *monitoring.drift;
  json["drift"] = {{"N_per_kN_per_year", drift.N_per_kN_per_year},
                   {"ci95", {drift.low_95, drift.high_95}},
                   {"p", drift.p_value},
                   {"over_time_N_per_kN", drift.over_time_N_per_kN}};
  return json;
}

double find_last_of_reference_s(const AlignmentFile& file) {
  double last_s = 0.0;
  for (const AlignmentTire& tire : file.tires) last_s = std::max(last_s, tire.reference.all.back().time_s);
  return last_s;
}

/// A key of a stored alignment, which may lie in an object: "line.A2.value".
const Json& find_key(const Json& document, const std::string& path, const std::string& file) {
  const Json* at = &document;
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string key = path.substr(begin, end - begin);
    if (!at->is_object() || !at->contains(key)) {
      throw InputError(
          {"a key of the alignment is missing", file, 0, path, "", "a file that 'rollrig align' wrote", ""});
    }
    at = &at->at(key);
    begin = end + 1;
  }
  return *at;
}

InputError make_key_error(const std::string& file, const std::string& path, const Json& value,
                          const std::string& allowed) {
  return InputError({"a key of the alignment is wrong", file, 0, path, value.dump(), allowed, ""});
}

double read_number(const Json& document, const std::string& path, const std::string& file, double least) {
  const Json& value = find_key(document, path, file);
  if (value.is_number() && value.get<double>() >= least) return value.get<double>();
  throw make_key_error(file, path, value, least > -1e9 ? fmt::format("a number >= {:g}", least) : "a number");
}

std::string read_word(const Json& document, const std::string& path, const std::string& file) {
  const Json& value = find_key(document, path, file);
  if (value.is_string()) return value.get<std::string>();
  throw make_key_error(file, path, value, "a text");
}

AlignmentLine read_line(const Json& document, const std::string& file) {
  constexpr double kAny = -1e9;
  constexpr double kTiny = 1e-9;
  const auto number = [&](const char* path, double least) { return read_number(document, path, file, least); };
  AlignmentLine line;
  line.A1 = number("A1", kTiny);
  line.B1 = number("B1_N_per_kN", kAny);
  line.A2 = number("line.A2.value", kTiny);
  line.B2 = number("line.B2_N_per_kN.value", kAny);
  line.tires = number("line.tires", 3.0);
  line.mean_x = number("line.mean_measured_N_per_kN", 0.0);
  line.Sxx = number("line.Sxx_N2_per_kN2", kTiny);
  line.line_sd = number("line.line_sd_N_per_kN", 0.0);
  line.line_freedom = number("line.line_degrees_of_freedom", 1.0);
  line.between_sd = number("line.between_tires_sd_N_per_kN", 0.0);
  line.between_freedom = line.tires - 2.0;
  line.candidate_sd = number("line.candidate_mean_sd_N_per_kN", 0.0);
  line.rest_sd = number("line.rest_sd_N_per_kN", 0.0);
  line.rest_freedom = find_key(document, "line.rest_degrees_of_freedom", file).is_null()
                          ? std::numeric_limits<double>::infinity()
                          : number("line.rest_degrees_of_freedom", 1.0);
  line.sigma_m = number("sigma_m_N_per_kN.value", 0.0);
  line.sigma_m_freedom = number("sigma_m_N_per_kN.degrees_of_freedom", 1.0);
  return line;
}

/// Refuses a file of which a part was changed by hand: what it states twice has to agree.
void require_consistent(const Json& document, const StoredAlignment& stored, const std::string& last_measurement,
                        const std::string& file) {
  constexpr double kAny = -1e9;
  const auto require = [&](const char* path, double expected, const char* made_of) {
    const double found = read_number(document, path, file, kAny);
    if (std::abs(found - expected) <= 1e-9 * std::max(1.0, std::abs(expected))) return;
    throw InputError({"keys of the alignment contradict each other: was the file changed by hand?", file, 0, path,
                      fmt::format("{:.6g}", found), fmt::format("{} = {:.6g}", made_of, expected), ""});
  };
  require("aligned.factor", stored.line.calc_factor(), "A1 A2");
  require("aligned.offset_N_per_kN", stored.line.calc_offset(), "A1 B2 + B1");
  const std::string expected =
      format_day(add_years(read_day_s(last_measurement, "last_measurement"), AlignmentRules{}.years_valid));
  if (stored.valid_until == expected) return;
  throw InputError({"keys of the alignment contradict each other: was the file changed by hand?", file, 0,
                    "valid_until", stored.valid_until,
                    fmt::format("{}, {} years after last_measurement", expected, AlignmentRules{}.years_valid), ""});
}

/// The earliest of the last measurements of the control tires; empty without control tires.
std::string find_last_control(const Json& document, const std::string& file) {
  if (!document.contains("monitoring")) return "";
  const Json& tires = find_key(document, "monitoring.tires", file);
  if (!tires.is_array()) throw make_key_error(file, "monitoring.tires", tires, "a list");
  std::string last;
  for (const Json& tire : tires) {
    const std::string day = read_word(tire, "last_measurement", file);
    if (last.empty() || day < last) last = day;
  }
  return last;
}

}  // namespace

std::vector<AlignedExample> list_aligned_examples(const AlignmentResult& result) {
  std::vector<AlignedExample> examples;
  const double low = result.fit.points.front().x, high = result.fit.points.back().x;
  for (const double share : {0.0, 0.5, 1.0}) {
    const double measured = low + share * (high - low);
    const UncertainValue one = align_value(result.line, measured, 1);
    const UncertainValue three = align_value(result.line, measured, 3);
    examples.push_back({measured, one.value, one.coverage_factor * one.sd, three.coverage_factor * three.sd});
  }
  return examples;
}

Json make_alignment_json(const AlignmentFile& file, const AlignmentResult& result) {
  Json json = {{"format", kAlignmentFormat}, {"file", file.path}, {"machine", file.machine}};
  if (!file.reference_machine.empty()) json["reference_machine"] = file.reference_machine;
  json["classes"] = file.rules.classes;
  json["aligned_to"] = file.is_assigned       ? "assigned values"
                       : result.is_of_network ? "reference machine, then A1 and B1"
                                              : "reference machine";
  json["first_measurement"] = format_day(file.first_s);
  json["last_measurement"] = format_day(file.last_s);
  if (!file.reference_machine.empty()) {
    json["last_measurement_of_reference"] = format_day(find_last_of_reference_s(file));
  }
  json["valid_from"] = format_day(std::max(file.last_s, file.complete_s));
  json["valid_until"] = format_day(result.valid_until_s);
  json["judged_on"] = format_day(result.judged_on_s);
  json["valid"] = result.is_valid;
  json["align_again_because"] = result.due_because;
  json["A1"] = result.line.A1;
  json["B1_N_per_kN"] = result.line.B1;
  json["aligned"] = {{"factor", result.line.calc_factor()}, {"offset_N_per_kN", result.line.calc_offset()}};
  json["line"] = make_line_json(result.fit, result.line);
  json["sigma_m_N_per_kN"] = alignment_json(result.sigma_m);
  if (result.sigma_l.has_value()) json["sigma_of_reference_N_per_kN"] = alignment_json(*result.sigma_l);
  json["measurements_needed"] = result.needed_measurements;
  json["range_measured_N_per_kN"] = {result.fit.points.front().x, result.fit.points.back().x};
  json["aligned_examples"] = make_list(list_aligned_examples(result), [](const AlignedExample& at) {
    return Json{{"measured_N_per_kN", at.measured_N_per_kN},
                {"aligned_N_per_kN", at.aligned_N_per_kN},
                {"expanded_of_one_N_per_kN", at.expanded_of_one_N_per_kN},
                {"expanded_of_three_N_per_kN", at.expanded_of_three_N_per_kN}};
  });
  json["tires"] = Json::array();
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    json["tires"].push_back(make_tire_json(file.tires[i], result.fit.points[i]));
  }
  json["checks"] = make_list(result.checks, [](const AlignmentCheck& check) {
    return Json{{"name", check.name},     {"found", check.found}, {"limit", check.limit},
                {"source", check.source}, {"met", check.is_met},  {"rule", check.is_rule}};
  });
  if (!result.monitoring.charts.empty()) json["monitoring"] = make_monitoring_json(result.monitoring);
  if (!result.reference_monitoring.charts.empty()) {
    json["reference_monitoring"] = make_monitoring_json(result.reference_monitoring);
  }
  if (!result.warnings.empty()) json["warnings"] = result.warnings;
  return json;
}

StoredAlignment read_alignment_json(const std::string& path) {
  const Json document = read_json(path);
  const std::string format = read_word(document, "format", path);
  if (format != kAlignmentFormat) {
    throw InputError({"this is no alignment", path, 0, "format", format, kAlignmentFormat, ""});
  }
  StoredAlignment stored;
  stored.line = read_line(document, path);
  stored.machine = read_word(document, "machine", path);
  stored.classes = read_word(document, "classes", path);
  stored.valid_from = read_word(document, "valid_from", path);
  stored.last_control = find_last_control(document, path);
  stored.valid_until = read_word(document, "valid_until", path);
  const Json& valid = find_key(document, "valid", path);
  if (!valid.is_boolean()) throw make_key_error(path, "valid", valid, "true or false");
  stored.is_valid = valid.get<bool>();
  const Json& range = find_key(document, "range_measured_N_per_kN", path);
  if (!range.is_array() || range.size() != 2 || !range[0].is_number() || !range[1].is_number()) {
    throw make_key_error(path, "range_measured_N_per_kN", range, "two numbers");
  }
  stored.low_N_per_kN = range[0].get<double>();
  stored.high_N_per_kN = range[1].get<double>();
  require_consistent(document, stored, read_word(document, "last_measurement", path), path);
  return stored;
}

std::string make_measurement_csv(const AlignmentFile& file, const AlignmentResult& result) {
  CsvWriter csv({"tire", "class", "machine", "date", "rrc_N_per_kN", "used", "aligned_N_per_kN"});
  const AlignmentLine& line = result.line;
  for (const AlignmentTire& tire : file.tires) {
    for (const bool is_candidate : {true, false}) {
      for (const AlignmentMeasurement& one : (is_candidate ? tire.candidate : tire.reference).all) {
        const double at_reference = is_candidate ? line.A2 * one.rrc_N_per_kN + line.B2 : one.rrc_N_per_kN;
        csv.add_row(tire.name, tire.tire_class, is_candidate ? file.machine : file.reference_machine,
                    format_day(one.time_s), one.rrc_N_per_kN, std::string(one.is_used ? "yes" : "no"),
                    CsvWriter::Rounded{line.A1 * at_reference + line.B1, 6});
      }
    }
  }
  return csv.take();
}

}  // namespace rollrig::estimation
