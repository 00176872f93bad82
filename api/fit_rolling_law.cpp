#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "api/add_uncertainty.h"
#include "api/option_range.h"
#include "api/report_files.h"
#include "estimation/rolling_law/rolling_output.h"
#include "estimation/rolling_law/rolling_uncertainty.h"
#include "exports/coefficients.h"
#include "report/rolling_law_page.h"
#include "rollrig/rolling_law.h"
#include "scenarios/common/speed_trace.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig {
namespace {

using estimation::RollingTest;

/// Takes an option in place of what the file says; warns where both contradict each other.
void put_option(const std::optional<double>& given, const char* option, const char* unit, double per_SI,
                std::optional<double>& value, std::vector<std::string>& warnings) {
  constexpr double kSame = 0.005;  // Assumed: rounding
  if (!given.has_value()) return;
  if (value.has_value() && std::abs(*given / *value - 1.0) > kSame) {
    warnings.push_back(
        fmt::format("{} is {:g} {}, but the result has {:g} {}: the standard reference condition is "
                    "that of the option",
                    option, per_SI * *given, unit, per_SI * *value, unit));
  }
  value = given;
}

/// The standard reference pressure is one that is set cold; a law over warm pressures is evaluated there.
void warn_of_warm_pressure(const std::string& path, RollingTest& test) {
  const RollingTest cold = estimation::read_rolling_test(path, estimation::PressureTaken::kSet);
  double rise_Pa = 0.0;
  for (std::size_t i = 0; i < test.points.size(); ++i) {
    rise_Pa += (test.points[i].pressure_Pa - cold.points[i].pressure_Pa) / static_cast<double>(test.points.size());
  }
  test.warnings.push_back(fmt::format(
      "--warm-pressure: the law is one of the pressure in the warm tire, on average {:.0f} kPa above the one that was "
      "set. The standard reference pressure is a cold one; taken as a warm one, it is that of a tire set to about "
      "{:.0f} kPa less",
      rise_Pa / 1e3, rise_Pa / 1e3));
}

/// The points of a file, and of the tire what the options say.
RollingTest read_points(const std::string& path, const RollingLawOptions& options) {
  if (options.maximum_load_N.has_value()) {
    require_within({"--maximum-load", 100.0, 100000.0, "N"}, *options.maximum_load_N);
  }
  if (options.base_pressure_Pa.has_value()) {
    require_within({"--base-pressure", 50.0, 1500.0, "kPa"}, 1e-3 * *options.base_pressure_Pa);
  }
  RollingTest test = estimation::read_rolling_test(
      path, options.warm_pressure ? estimation::PressureTaken::kWarm : estimation::PressureTaken::kSet);
  if (options.warm_pressure && !test.is_simulated) {
    throw InputError({"--warm-pressure is for results: a file of points has one pressure", path, 0, "--warm-pressure",
                      "", "no --warm-pressure, or the folder or result.json of a run", ""});
  }
  put_option(options.maximum_load_N, "--maximum-load", "N", 1.0, test.maximum_load_N, test.warnings);
  put_option(options.base_pressure_Pa, "--base-pressure", "kPa", 1e-3, test.base_pressure_Pa, test.warnings);
  if (options.warm_pressure) warn_of_warm_pressure(path, test);
  if (test.is_simulated) return test;  // the program set loads and pressures itself
  for (std::string& doubt : estimation::doubt_tire_limits(test.points, test.maximum_load_N, test.base_pressure_Pa)) {
    test.warnings.push_back(std::move(doubt));
  }
  return test;
}

/// The fit, its InputErrors with the file's name.
template <class Fit>
auto fit_points(const RollingTest& test, Fit&& fit) {
  try {
    return fit(test.points);
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (problem.file.empty()) problem.file = test.path;
    throw InputError(problem);
  }
}

std::optional<estimation::ReferenceCondition> find_reference(RollingTest& test) {
  if (test.maximum_load_N.has_value() && test.base_pressure_Pa.has_value()) {
    return estimation::make_standard_reference(*test.maximum_load_N, *test.base_pressure_Pa);
  }
  test.warnings.push_back(
      "no standard reference condition: the file does not say the tire's maximum load and base pressure; give both "
      "with --maximum-load and --base-pressure");
  return std::nullopt;
}

/// Whether a value lies in the range of a member of the points.
bool is_covered(const RollingTest& test, double estimation::RollingPoint::*member, double value) {
  const auto [low, high] =
      std::minmax_element(test.points.begin(), test.points.end(),
                          [member](const auto& first, const auto& second) { return first.*member < second.*member; });
  return (*low).*member <= value && value <= (*high).*member;
}

/// A reference outside of the points is an extrapolation. A law of one speed has no speed in it.
void warn_of_reference(const estimation::ReferenceCondition& at, bool has_speed, RollingTest& test) {
  if (!is_covered(test, &estimation::RollingPoint::load_N, at.load_N) ||
      !is_covered(test, &estimation::RollingPoint::pressure_Pa, at.pressure_Pa)) {
    test.warnings.push_back(fmt::format(
        "the standard reference condition ({:.0f} N, {:.0f} kPa) lies outside of the points: the law is extrapolated",
        at.load_N, at.pressure_Pa / 1e3));
  }
  if (has_speed && !is_covered(test, &estimation::RollingPoint::speed_m_s, at.speed_m_s)) {
    test.warnings.push_back(
        fmt::format("{:.0f} km/h lies outside of the speeds of the points: the law is extrapolated. Are they in km/h?",
                    kKmhPerMs * at.speed_m_s));
  }
}

estimation::CycleForces read_cycles(const RollingLawOptions& options, std::vector<std::string>& warnings) {
  const auto read = [&warnings](const std::string& name) {
    const scenarios::SpeedTrace trace = scenarios::read_speed_trace(name);
    for (std::string& doubt : scenarios::doubt_trace(trace)) warnings.push_back(std::move(doubt));
    return estimation::calc_speed_moments(trace.time_s, trace.speed_m_s);
  };
  return {options.urban_cycle, options.highway_cycle, read(options.urban_cycle), read(options.highway_cycle)};
}

std::vector<std::string> join_warnings(const RollingTest& test, const std::vector<std::string>& of_fit) {
  std::vector<std::string> warnings = test.warnings;
  warnings.insert(warnings.end(), of_fit.begin(), of_fit.end());
  return warnings;
}

std::string find_point_file_role(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".csv" || extension == ".json" ? "points" : "other file";
}

/// What both fits have in common: numbers, warnings, text, files and the test report.
template <class Fit>
RollingLaw make_law(const char* command, const RollingTest& test, const Fit& fit, const std::string& tables,
                    const Json& json, const ReadRecorder& recorder) {
  RollingLaw law;
  law.coefficients = fit.coefficients;
  law.warnings = join_warnings(test, fit.warnings);
  law.text = wrap(fmt::format("{}   {}   {}", command, test.path, format_count(test.points.size(), "point")), 0) +
             tables + format_warnings(law.warnings);
  law.json = to_text(json);
  law.make_files = [json = law.json, residuals = estimation::write_rolling_residuals(fit.points)] {
    return FolderFiles{{"fit.json", json}, {"residuals.csv", residuals}};
  };
  law.make_test_report = [test, json, files = list_report_files(recorder, &find_point_file_role)] {
    return report::make_report_html(report::make_rolling_law_report(test, json, files), report::find_report_date());
  };
  return law;
}

}  // namespace

RollingLaw fit_j2452(const std::string& path, const RollingLawOptions& options, const UncertaintyOptions& uncertainty,
                     const Progress& progress) {
  check_uncertainty(uncertainty);
  const ReadRecorder recorder;
  RollingTest test = read_points(path, options);
  // A simulated test has exact loads and pressures. If its sets lie off the law, the cause is the law.
  const auto random = test.is_simulated ? estimation::RandomPart::kPoints : estimation::RandomPart::kPointsAndSets;
  estimation::J2452Fit fit =
      fit_points(test, [random](const auto& points) { return estimation::fit_j2452(points, random); });
  if (const auto doubt = estimation::doubt_parasitic_loss(fit)) fit.warnings.push_back(*doubt);
  if (const auto doubt = estimation::doubt_sets(fit)) fit.warnings.push_back(*doubt);
  std::optional<estimation::J2452Reference> reference;
  if (const auto at = find_reference(test)) {
    warn_of_reference(*at, true, test);
    reference = estimation::evaluate_reference(fit, *at, read_cycles(options, test.warnings));
  }
  Json json = estimation::make_j2452_json(test, fit, reference);
  std::string tables = format_tables(report::make_j2452_tables(fit, reference));
  std::vector<Table> budgets;
  if (wants_uncertainty(uncertainty, fit.statistics.freedom > 0)) {
    budgets = add_uncertainty(estimation::make_j2452_model(test, fit, reference), uncertainty, progress, json);
    tables += format_tables(budgets);
  }
  RollingLaw law = make_law("fit j2452", test, fit, tables, json, recorder);
  law.make_page = [test, fit, reference, budgets] {
    return make_page_with_uncertainty(report::make_j2452_page(test, fit, reference), budgets);
  };
  return law;
}

RollingLaw fit_j1269(const std::string& path, const RollingLawOptions& options, bool proportional,
                     const UncertaintyOptions& uncertainty, const Progress& progress) {
  check_uncertainty(uncertainty);
  const auto form = proportional ? estimation::MultipointForm::kProportional : estimation::MultipointForm::kBilinear;
  const ReadRecorder recorder;
  RollingTest test = read_points(path, options);
  const estimation::MultipointFit fit =
      fit_points(test, [form](const auto& points) { return estimation::fit_multipoint(points, form); });
  std::optional<estimation::MultipointReference> reference;
  if (const auto at = find_reference(test)) {
    warn_of_reference(*at, false, test);
    reference = {{at->load_N, at->pressure_Pa, fit.speed_m_s}, fit.estimate_force(at->load_N, at->pressure_Pa)};
  }
  Json json = estimation::make_multipoint_json(test, fit, reference);
  std::string tables = format_tables(report::make_multipoint_tables(fit, reference));
  std::vector<Table> budgets;
  if (wants_uncertainty(uncertainty, fit.statistics.freedom > 0)) {
    budgets = add_uncertainty(estimation::make_multipoint_model(test, fit, reference), uncertainty, progress, json);
    tables += format_tables(budgets);
  }
  RollingLaw law = make_law("fit j1269", test, fit, tables, json, recorder);
  law.make_page = [test, fit, reference, budgets] {
    return make_page_with_uncertainty(report::make_multipoint_page(test, fit, reference), budgets);
  };
  return law;
}

std::vector<std::string> list_fit_warnings(const std::string& fit_json) {
  return exports::read_rolling_coefficients(fit_json).warnings;
}

std::string export_coefficients(const std::string& fit_json, CoefficientTarget target,
                                const CoefficientOptions& options) {
  if (options.tire_radius_m.has_value()) require_within({"--tire-radius", 0.05, 2.0, "m"}, *options.tire_radius_m);
  require_within({"--tires", 1.0, 100.0, ""}, options.tires);
  const exports::RollingCoefficients coefficients = exports::read_rolling_coefficients(fit_json);
  switch (target) {
    case CoefficientTarget::kTydex:
      return exports::make_tydex(coefficients);
    case CoefficientTarget::kTir:
      return exports::make_tir(coefficients, options.tire_radius_m);
    case CoefficientTarget::kSimscape:
      return exports::make_simscape(coefficients);
    case CoefficientTarget::kFastsim:
      return exports::make_fastsim(coefficients);
    case CoefficientTarget::kCo2mpas:
      break;
  }
  return exports::make_co2mpas(coefficients, options.tires);
}

}  // namespace rollrig
