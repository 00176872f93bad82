#include "rollrig/align.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "api/add_uncertainty.h"
#include "estimation/alignment/alignment.h"
#include "estimation/alignment/alignment_doubts.h"
#include "estimation/alignment/alignment_uncertainty.h"
#include "measurements/logs/time_stamps.h"
#include "report/alignment_page.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace rollrig {
namespace {

ParameterEstimate make_estimate(const std::string& name, double value, double sd, double k, const std::string& unit) {
  return {name, value, sd, value - k * sd, value + k * sd, unit};
}

void fill_numbers(const estimation::AlignmentResult& result, Alignment& alignment) {
  const estimation::LineFit& fit = result.fit;
  const double k = fit.coverage_factor();
  alignment.A2 = make_estimate("A2", fit.slope, fit.slope_sd(), k, "");
  alignment.B2 = make_estimate("B2", fit.offset, fit.offset_sd(), k, "N/kN");
  alignment.A1 = result.line.A1;
  alignment.B1_N_per_kN = result.line.B1;
  const estimation::ScatterEstimate& sigma_m = result.sigma_m;
  alignment.sigma_m = {"sigma_m",      sigma_m.sd,      sigma_m.sd / std::sqrt(2.0 * sigma_m.degrees_of_freedom),
                       sigma_m.low_95, sigma_m.high_95, "N/kN"};
  alignment.checks = result.checks;
  alignment.valid_until = estimation::format_day(result.valid_until_s);
  alignment.is_valid = result.is_valid;
  alignment.is_due = !result.due_because.empty();
  alignment.is_of_network = result.is_of_network;
  alignment.warnings = result.warnings;
}

Json make_value_json(const AlignedValueInput& input, const estimation::StoredAlignment& stored,
                     const estimation::UncertainValue& aligned, const AlignedValue& value) {
  const double half = aligned.coverage_factor * aligned.sd;
  Json json = {{"format", "rollrig-aligned-value/1"},
               {"alignment", input.alignment},
               {"machine", stored.machine},
               {"classes", stored.classes},
               {"measured_N_per_kN", input.rrc_N_per_kN},
               {"measurements", input.measurements},
               {"alignment_is_valid", value.is_valid},
               {"aligned_N_per_kN", aligned.value},
               {"sd_N_per_kN", aligned.sd},
               {"degrees_of_freedom", aligned.degrees_of_freedom},
               {"coverage_factor", aligned.coverage_factor},
               {"ci95_N_per_kN", {aligned.value - half, aligned.value + half}}};
  json["contributions"] = make_list(aligned.contributions, [](const estimation::AlignedContribution& one) {
    return Json{{"name", one.name}, {"sd_N_per_kN", one.sd}, {"degrees_of_freedom", one.degrees_of_freedom}};
  });
  if (!value.warnings.empty()) json["warnings"] = value.warnings;
  return json;
}

void check_value_input(const AlignedValueInput& input) {
  if (input.measurements < 1) {
    throw InputError({"a value is the mean of one measurement at least", "command line", 0, "--measurements",
                      fmt::format("{}", input.measurements), "a whole number >= 1", ""});
  }
  const double value = input.rrc_N_per_kN;
  if (value >= estimation::kLeastRrc_N_per_kN && value <= estimation::kMostRrc_N_per_kN) return;
  throw InputError({"this is no rolling resistance coefficient in N/kN" + estimation::guess_unit(value), "command line",
                    0, "--rrc", fmt::format("{:g}", value),
                    fmt::format("{:g} to {:g} N/kN", estimation::kLeastRrc_N_per_kN, estimation::kMostRrc_N_per_kN),
                    ""});
}

std::string find_day(const AlignedValueInput& input) {
  return input.on.empty() ? report::find_report_date() : input.on;
}

/// Why an alignment does not hold for a value; empty where it does.
std::vector<std::string> list_reasons_against(const AlignedValueInput& input,
                                              const estimation::StoredAlignment& stored) {
  std::vector<std::string> reasons;
  if (!stored.is_valid) reasons.push_back("the alignment is not valid: its own report says why");
  const std::string on = find_day(input);
  const double on_s = estimation::read_day_s(on, "--on");
  if (on_s > estimation::read_day_s(stored.valid_until, "valid_until")) {
    reasons.push_back(fmt::format("the alignment was valid until {}, which is before {}", stored.valid_until, on));
  }
  if (on_s < estimation::read_day_s(stored.valid_from, "valid_from")) {
    reasons.push_back(
        fmt::format("the alignment was measured until {}, which is after {}: it does not hold for a value "
                    "of that day",
                    stored.valid_from, on));
  }
  return reasons;
}

/// What the control tires of the alignment leave open on the day of the value.
std::optional<std::string> doubt_controls(const std::string& on, const estimation::StoredAlignment& stored) {
  if (stored.last_control.empty()) return std::nullopt;
  const double days = (estimation::read_day_s(on, "--on") -
                       estimation::read_day_s(stored.last_control, "monitoring.tires")) /
                      measurements::kDay_s;
  if (days <= estimation::kMostControlDays) return std::nullopt;
  return fmt::format(
      "the alignment has control measurements until {}, {:.0f} days before {}; expected {:g} at most (UN R117 Annex 6; "
      "second-hand): align with the later ones, which show whether the machine has drifted",
      stored.last_control, days, on, estimation::kMostControlDays);
}

/// Refuses a value of a class that the alignment does not hold for.
void check_value_class(const AlignedValueInput& input, const estimation::StoredAlignment& stored) {
  if (input.tire_class.empty()) return;
  const auto& known = estimation::kTireClasses;
  if (std::find(known.begin(), known.end(), input.tire_class) == known.end()) {
    InputProblem problem = unknown_name("tire class", input.tire_class, known);
    problem.file = "command line";
    problem.key = "--class";
    throw InputError(problem);
  }
  if (stored.classes.find(input.tire_class) != std::string::npos) return;
  throw InputError({fmt::format("the alignment does not hold for class {}", input.tire_class), input.alignment, 0,
                    "--class", input.tire_class, stored.classes, ""});
}

/// Whether the alignment holds for the value, and what else is to be said of it.
void judge_value(const AlignedValueInput& input, const estimation::StoredAlignment& stored, AlignedValue& value) {
  value.warnings = list_reasons_against(input, stored);
  value.is_valid = value.warnings.empty();
  if (const auto doubt = doubt_controls(find_day(input), stored); doubt.has_value()) value.warnings.push_back(*doubt);
  constexpr double kShown_N_per_kN = 0.005;  // to which a value and the range are shown
  if (input.rrc_N_per_kN < stored.low_N_per_kN - kShown_N_per_kN ||
      input.rrc_N_per_kN > stored.high_N_per_kN + kShown_N_per_kN) {
    value.warnings.push_back(
        fmt::format("{:.2f} N/kN lies outside the alignment tires, {:.2f} to {:.2f} N/kN: the line is "
                    "extrapolated",
                    input.rrc_N_per_kN, stored.low_N_per_kN, stored.high_N_per_kN));
  }
}

/// The files of the measurements, as they were read.
std::vector<report::ReportFile> list_alignment_inputs(const estimation::AlignmentFile& file) {
  std::vector<report::ReportFile> inputs;
  for (const std::string& path : file.inputs) {
    inputs.push_back(
        {inputs.empty() ? "measurements" : "values of the reference", path, calc_sha256(read_text_file(path))});
  }
  return inputs;
}

}  // namespace

Alignment align(const AlignmentInput& input, const UncertaintyOptions& uncertainty, const Progress& progress) {
  check_uncertainty(uncertainty);
  const auto file = std::make_shared<const estimation::AlignmentFile>(estimation::read_alignment_file(input));
  estimation::AlignmentResult aligned = estimation::align_machine(*file, input);
  for (const std::string& doubt : estimation::list_date_doubts(*file, report::find_report_date())) {
    aligned.warnings.push_back(doubt);
  }
  const auto result = std::make_shared<const estimation::AlignmentResult>(std::move(aligned));
  Alignment alignment;
  fill_numbers(*result, alignment);
  alignment.text = fmt::format("align   {}   classes {}\n", file->path, file->rules.classes) +
                   format_tables(report::make_alignment_tables(*file, *result));
  Json json = estimation::make_alignment_json(*file, *result);
  std::vector<Table> budgets;
  if (wants_uncertainty(uncertainty)) {
    budgets = add_uncertainty(estimation::make_alignment_model(*result), uncertainty, progress, json);
    alignment.text += format_tables(budgets);
  }
  alignment.text += format_warnings(result->warnings);
  alignment.json = to_text(json);
  alignment.make_files = [file, result, json = alignment.json] {
    return FolderFiles{{"alignment.json", json},
                       {"measurements.csv", estimation::make_measurement_csv(*file, *result)}};
  };
  alignment.make_test_report = [file, result, json = std::move(json), files = list_alignment_inputs(*file)] {
    return report::make_report_html(report::make_alignment_report(*file, *result, json, files),
                                    report::find_report_date());
  };
  alignment.make_page = [file, result, budgets] {
    return make_page_with_uncertainty(report::make_alignment_page(*file, *result), budgets);
  };
  return alignment;
}

AlignedValue apply_alignment(const AlignedValueInput& input, const UncertaintyOptions& uncertainty,
                             const Progress& progress) {
  check_uncertainty(uncertainty);
  check_value_input(input);
  const estimation::StoredAlignment stored = estimation::read_alignment_json(input.alignment);
  check_value_class(input, stored);
  const estimation::UncertainValue aligned =
      estimation::align_value(stored.line, input.rrc_N_per_kN, input.measurements);
  AlignedValue value;
  value.rrc = make_estimate("rrc_aligned", aligned.value, aligned.sd, aligned.coverage_factor, "N/kN");
  judge_value(input, stored, value);
  value.text = fmt::format("align   {}   classes {}\n", input.alignment, stored.classes) +
               format_tables(report::make_aligned_value_tables(input.rrc_N_per_kN, input.measurements, aligned));
  Json json = make_value_json(input, stored, aligned, value);
  if (wants_uncertainty(uncertainty)) {
    const estimation::MeasurementModel model =
        estimation::make_aligned_value_model(stored.line, input.rrc_N_per_kN, input.measurements);
    value.text += format_tables(add_uncertainty(model, uncertainty, progress, json));
  }
  value.text += format_warnings(value.warnings);
  value.json = to_text(json);
  return value;
}

}  // namespace rollrig
