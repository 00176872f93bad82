#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "estimation/rolling_law/rolling_output.h"
#include "exports/coefficients.h"
#include "report/rolling_law_page.h"
#include "rollrig/rolling_law.h"
#include "scenarios/common/speed_trace.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

using estimation::RollingTest;

/// The points of a file, and of the tire what the options say.
RollingTest read_points(const std::string& path, const RollingLawOptions& options) {
  RollingTest test = estimation::read_rolling_test(
      path, options.warm_pressure ? estimation::PressureTaken::kWarm : estimation::PressureTaken::kSet);
  if (options.maximum_load_N.has_value()) test.maximum_load_N = options.maximum_load_N;
  if (options.base_pressure_Pa.has_value()) test.base_pressure_Pa = options.base_pressure_Pa;
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
      "with "
      "--maximum-load and --base-pressure");
  return std::nullopt;
}

/// Whether a value lies in the range of a member of the points.
bool is_covered(const RollingTest& test, double estimation::RollingPoint::*member, double value) {
  const auto [low, high] =
      std::minmax_element(test.points.begin(), test.points.end(),
                          [member](const auto& first, const auto& second) { return first.*member < second.*member; });
  return (*low).*member <= value && value <= (*high).*member;
}

/// A reference outside of the points is an extrapolation.
void warn_of_reference(const estimation::ReferenceCondition& at, RollingTest& test) {
  if (is_covered(test, &estimation::RollingPoint::load_N, at.load_N) &&
      is_covered(test, &estimation::RollingPoint::pressure_Pa, at.pressure_Pa)) {
    return;
  }
  test.warnings.push_back(fmt::format(
      "the standard reference condition ({:.0f} N, {:.0f} kPa) lies outside of the points: the law is extrapolated",
      at.load_N, at.pressure_Pa / 1e3));
}

estimation::CycleForces read_cycles(const RollingLawOptions& options) {
  const auto read = [](const std::string& name) {
    const scenarios::SpeedTrace trace = scenarios::read_speed_trace(name);
    return estimation::calc_speed_moments(trace.time_s, trace.speed_m_s);
  };
  return {options.urban_cycle, options.highway_cycle, read(options.urban_cycle), read(options.highway_cycle)};
}

std::string start_text(const char* command, const RollingTest& test) {
  return wrap(fmt::format("{}   {}   {}", command, test.path, format_count(test.points.size(), "point")), 0);
}

std::vector<std::string> join_warnings(const RollingTest& test, const std::vector<std::string>& of_fit) {
  std::vector<std::string> warnings = test.warnings;
  warnings.insert(warnings.end(), of_fit.begin(), of_fit.end());
  return warnings;
}

}  // namespace

RollingLaw fit_j2452(const std::string& path, const RollingLawOptions& options) {
  const auto test = std::make_shared<RollingTest>(read_points(path, options));
  const auto fit = std::make_shared<const estimation::J2452Fit>(fit_points(*test, &estimation::fit_j2452));
  std::optional<estimation::J2452Reference> reference;
  if (const auto at = find_reference(*test)) {
    warn_of_reference(*at, *test);
    reference = estimation::evaluate_reference(*fit, *at, read_cycles(options));
  }
  RollingLaw law;
  law.coefficients = fit->coefficients;
  law.warnings = join_warnings(*test, fit->warnings);
  law.text = start_text("fit j2452", *test) + format_tables(report::make_j2452_tables(*fit, reference)) +
             format_warnings(law.warnings);
  law.json = to_text(estimation::make_j2452_json(*test, *fit, reference));
  law.make_files = [fit, json = law.json] {
    return FolderFiles{{"fit.json", json}, {"residuals.csv", estimation::write_rolling_residuals(fit->points)}};
  };
  law.make_page = [test, fit, reference] { return report::make_html(report::make_j2452_page(*test, *fit, reference)); };
  return law;
}

RollingLaw fit_j1269(const std::string& path, const RollingLawOptions& options, bool proportional) {
  const auto form = proportional ? estimation::MultipointForm::kProportional : estimation::MultipointForm::kBilinear;
  const auto test = std::make_shared<RollingTest>(read_points(path, options));
  const auto fit = std::make_shared<const estimation::MultipointFit>(
      fit_points(*test, [form](const auto& points) { return estimation::fit_multipoint(points, form); }));
  std::optional<estimation::MultipointReference> reference;
  if (const auto at = find_reference(*test)) {
    warn_of_reference(*at, *test);
    reference = {{at->load_N, at->pressure_Pa, fit->speed_m_s}, fit->estimate_force(at->load_N, at->pressure_Pa)};
  }
  RollingLaw law;
  law.coefficients = fit->coefficients;
  law.warnings = join_warnings(*test, fit->warnings);
  law.text = start_text("fit j1269", *test) + format_tables(report::make_multipoint_tables(*fit, reference)) +
             format_warnings(law.warnings);
  law.json = to_text(estimation::make_multipoint_json(*test, *fit, reference));
  law.make_files = [fit, json = law.json] {
    return FolderFiles{{"fit.json", json}, {"residuals.csv", estimation::write_rolling_residuals(fit->points)}};
  };
  law.make_page = [test, fit, reference] {
    return report::make_html(report::make_multipoint_page(*test, *fit, reference));
  };
  return law;
}

std::string export_coefficients(const std::string& fit_json, CoefficientTarget target,
                                const CoefficientOptions& options) {
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
