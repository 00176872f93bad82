#include "exports/coefficients.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/core/error.h"
#include "sim/core/parse_json.h"
#include "sim/core/text.h"
#include "sim/core/units.h"
#include "sim/core/visible.h"

namespace fs = std::filesystem;

namespace rollrig::exports {
namespace {

constexpr const char* kFitFormat = "rollrig-j2452-fit/1";

/// A number of the document by its path, such as "coefficients.a.value".
double find_fit_number(const Json& json, const std::vector<std::string>& keys, const std::string& path) {
  const Json* at = &json;
  for (const std::string& key : keys) {
    if (!at->is_object() || !at->contains(key)) {
      throw InputError({"the fit lacks a number", path, 0, fmt::format("{}", fmt::join(keys, ".")), "",
                        "fit.json as rollrig fit j2452 writes it", ""});
    }
    at = &at->at(key);
  }
  if (at->is_number()) return at->get<double>();
  throw InputError({"not a number", path, 0, fmt::format("{}", fmt::join(keys, ".")), "",
                    "fit.json as rollrig fit j2452 writes it", ""});
}

Json read_fit_document(const std::string& path) {
  Json json = read_json(path);
  const Json format = json.is_object() ? json.value("format", Json()) : Json();
  if (format == kFitFormat) return json;
  throw InputError({"coefficients are exported from a fit of SAE J2452", path, 0, "format",
                    format.is_string() ? format.get<std::string>() : "",
                    fmt::format("\"{}\", which rollrig fit j2452 writes", kFitFormat), ""});
}

/// The law's force over F0 at the reference load and pressure.
double calc_speed_share(const RollingCoefficients& at, double speed_m_s) {
  const estimation::ReferenceCondition& reference = at.require_reference();
  return at.law.calc_force_N(reference.pressure_Pa, reference.load_N, speed_m_s) / reference.load_N;
}

/// Where numbers come from, as the first lines of a file.
std::string make_origin(const RollingCoefficients& at, const char* comment) {
  const std::string tire = at.tire.empty() ? "" : fmt::format("{} tire {}\n", comment, at.tire);
  const std::string doubts = at.warnings.empty() ? ""
                                                 : fmt::format("{} The fit has {}, in its fit.json\n", comment,
                                                               format_count(at.warnings.size(), "warning"));
  return fmt::format(
      "{} Rolling resistance by SAE J2452, fitted by rollrig: F = P^alpha Z^beta (a + b v + c v^2)\n{}{}", comment,
      tire, doubts);
}

std::string describe_condition(const RollingCoefficients& at) {
  const estimation::ReferenceCondition& reference = at.require_reference();
  return fmt::format("{:.6g} N, {:.6g} kPa gauge", reference.load_N, reference.pressure_Pa / 1e3);
}

}  // namespace

const estimation::ReferenceCondition& RollingCoefficients::require_reference() const {
  if (reference.has_value()) return *reference;
  throw InputError({"the fit has no reference condition of load and pressure", path, 0, "reference", "",
                    "a fit that was given --maximum-load and --base-pressure", ""});
}

RollingCoefficients read_rolling_coefficients(const std::string& path) {
  RollingCoefficients result;
  result.path = fs::is_directory(path) ? (fs::path(path) / "fit.json").string() : path;
  const Json json = read_fit_document(result.path);
  const auto coefficient = [&](const char* name) {
    return find_fit_number(json, {"coefficients", name, "value"}, result.path);
  };
  result.law = {coefficient("alpha"), coefficient("beta"), coefficient("a"), coefficient("b"), coefficient("c")};
  const Json points = json.value("points", Json::array());
  for (const Json& point : points) {
    const auto number = [&](const char* key) {
      return unit_of_key(key).to_si(find_fit_number(point, {key}, result.path));
    };
    result.points.push_back(
        {number("speed_km_h"), number("load_N"), number("pressure_kPa"), number("rolling_resistance_N")});
  }
  if (result.points.empty()) {
    throw InputError(
        {"the fit has no points", result.path, 0, "points", "", "fit.json as rollrig fit j2452 writes it", ""});
  }
  const auto [low, high] = std::minmax_element(result.points.begin(), result.points.end(),
                                               [](auto& a, auto& b) { return a.speed_m_s < b.speed_m_s; });
  result.low_m_s = low->speed_m_s;
  result.high_m_s = high->speed_m_s;
  const Json tire = json.value("tire", Json());
  if (tire.is_string()) result.tire = show_on_one_line(tire.get<std::string>());
  const Json warnings = json.value("warnings", Json::array());
  for (const Json& warning : warnings) {
    if (warning.is_string()) result.warnings.push_back(show_on_one_line(warning.get<std::string>()));
  }
  if (!json.contains("reference")) return result;
  const auto number = [&](const char* key) {
    return unit_of_key(key).to_si(find_fit_number(json, {"reference", key}, result.path));
  };
  result.reference = {number("load_N"), number("pressure_kPa"), number("speed_km_h")};
  for (const char* key : {"load_N", "pressure_kPa", "speed_km_h"}) {
    if (number(key) > 0.0) continue;
    throw InputError({"the reference condition is not positive", result.path, 0, fmt::format("reference.{}", key), "",
                      "a positive number", ""});
  }
  result.smerf_N = find_fit_number(json, {"reference", "smerf", "value_N"}, result.path);
  const double urban_share = find_fit_number(json, {"reference", "smerf", "urban_share"}, result.path);
  const auto name_cycle = [&json](const char* key) {
    const Json mean = json["reference"].value(key, Json());
    const Json cycle = mean.is_object() ? mean.value("cycle", Json()) : Json();
    return cycle.is_string() ? show_on_one_line(cycle.get<std::string>()) : std::string("another cycle");
  };
  result.cycles = fmt::format("{} ({:.4g}) and {} ({:.4g})", name_cycle("merf_urban"), urban_share,
                              name_cycle("merf_highway"), 1.0 - urban_share);
  return result;
}

MagicFormulaSpeeds fit_magic_formula(const RollingCoefficients& coefficients) {
  constexpr int kSamples = 101;
  const double v0_m_s = coefficients.require_reference().speed_m_s;
  const double at_v0 = calc_speed_share(coefficients, v0_m_s);
  Eigen::MatrixXd design(kSamples, 2);
  Eigen::VectorXd target(kSamples), share(kSamples), x(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double speed_m_s = coefficients.low_m_s + (coefficients.high_m_s - coefficients.low_m_s) * i / (kSamples - 1);
    x(i) = speed_m_s / v0_m_s;
    share(i) = calc_speed_share(coefficients, speed_m_s);
    design.row(i) << (x(i) - 1.0) / share(i), (std::pow(x(i), 4) - 1.0) / share(i);
    target(i) = (share(i) - at_v0) / share(i);
  }
  const Eigen::Vector2d found = design.colPivHouseholderQr().solve(target);
  MagicFormulaSpeeds speeds;
  speeds.q = {at_v0 - found(0) - found(1), found(0), found(1)};
  for (int i = 0; i < kSamples; ++i) {
    const double formula = speeds.q[0] + speeds.q[1] * x(i) + speeds.q[2] * std::pow(x(i), 4);
    speeds.deviation = std::max(speeds.deviation, std::abs(formula / share(i) - 1.0));
  }
  return speeds;
}

std::string make_tydex(const RollingCoefficients& coefficients) {
  const auto row = [](const char* name, const char* doc, const char* unit, const std::string& value) {
    return fmt::format("{:<10}{:<30}{:<10}{}\n", name, doc, unit, value);
  };
  std::string text = "**HEADER\n";
  text += row("RELEASE", "Release of TYDEX-Format", "", "1.3");
  text += row("MEASID", "Measurement ID", "", coefficients.tire.empty() ? "rollrig" : coefficients.tire);
  text += "**COMMENTS\n" + make_origin(coefficients, "!");
  text +=
      fmt::format("! alpha {:.9g}, beta {:.9g}, a {:.9g}, b {:.9g}, c {:.9g} (kPa, N, km/h)\n", coefficients.law.alpha,
                  coefficients.law.beta, coefficients.law.a, coefficients.law.b, coefficients.law.c);
  text += "! FX is the rolling resistance, negative since it retards; INFLPRES is gauge pressure\n**CONSTANTS\n";
  text += row("SLIPANGL", "Slip angle", "rad", "0");
  text += row("INCLANGL", "Inclination angle", "rad", "0");
  if (coefficients.reference.has_value()) {
    text += row("FNOMIN", "Load at the reference", "N", fmt::format("{:.6g}", coefficients.reference->load_N));
    text +=
        row("NOMPRES", "Pressure at the reference", "Pa", fmt::format("{:.6g}", coefficients.reference->pressure_Pa));
  }
  const auto channel = [](const char* name, const char* doc, const char* unit) {
    return fmt::format("{:<10}{:<30}{:<10}{:<10}{:<10}{:<10}\n", name, doc, unit, "1", "0", "0");
  };
  text += "**MEASURCHANNELS\n";
  text += channel("MEASNUMB", "Number of the point", "-") + channel("LONGVEL", "Longitudinal velocity", "m/s") +
          channel("FZW", "Vertical force", "N") + channel("INFLPRES", "Inflation pressure", "Pa") +
          channel("FX", "Longitudinal force", "N");
  text += "**MEASURDATA\n";
  for (std::size_t i = 0; i < coefficients.points.size(); ++i) {
    const estimation::RollingPoint& point = coefficients.points[i];
    text += fmt::format("{:<10} {:<12.6g} {:<12.7g} {:<12.7g} {:<12.6g}\n", i + 1, point.speed_m_s, point.load_N,
                        point.pressure_Pa, -point.force_N);
  }
  return text + "**END\n";
}

std::string make_tir(const RollingCoefficients& coefficients, const std::optional<double>& tire_radius_m) {
  const estimation::ReferenceCondition& reference = coefficients.require_reference();
  if (!tire_radius_m.has_value()) {
    throw InputError({"a .tir file holds the unloaded radius of the tire, and the fit does not say it",
                      coefficients.path, 0, "--tire-radius", "", "--tire-radius <m>", ""});
  }
  const MagicFormulaSpeeds speeds = fit_magic_formula(coefficients);
  std::string text = "[MDI_HEADER]\nFILE_TYPE = 'tir'\nFILE_VERSION = 3.0\nFILE_FORMAT = 'ASCII'\n";
  text += make_origin(coefficients, "! :");
  text += fmt::format(
      "! : rolling resistance alone: to be put into the file of a whole tire\n"
      "! : 1, v and v^4 in the place of 1, v and v^2: exact at {:.4g} km/h, within {:.2g} % from {:.4g} to {:.4g} "
      "km/h\n",
      kKmhPerMs * reference.speed_m_s, 100.0 * speeds.deviation, kKmhPerMs * coefficients.low_m_s,
      kKmhPerMs * coefficients.high_m_s);
  text += "[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nANGLE = 'radians'\nMASS = 'kg'\nTIME = 'second'\n";
  text += fmt::format("[MODEL]\nFITTYP = 62\nLONGVL = {:.9g}\n", reference.speed_m_s);
  text += fmt::format("[DIMENSION]\nUNLOADED_RADIUS = {:.9g}\n", *tire_radius_m);
  text += fmt::format("[OPERATING_CONDITIONS]\nINFLPRES = {0:.9g}\nNOMPRES = {0:.9g}\n", reference.pressure_Pa);
  text += fmt::format("[VERTICAL]\nFNOMIN = {:.9g}\n[SCALING_COEFFICIENTS]\nLMY = 1\n", reference.load_N);
  text += "[ROLLING_COEFFICIENTS]\n";
  const std::array<double, 8> qsy{speeds.q[0], 0.0, speeds.q[1],           speeds.q[2],
                                  0.0,         0.0, coefficients.law.beta, coefficients.law.alpha};
  for (std::size_t i = 0; i < qsy.size(); ++i) text += fmt::format("QSY{} = {:.9g}\n", i + 1, qsy[i]);
  return text;
}

std::string make_simscape(const RollingCoefficients& coefficients) {
  const estimation::ReferenceCondition& reference = coefficients.require_reference();
  const estimation::J2452Law& law = coefficients.law;
  const double per_Pa = std::pow(1e3, -law.alpha);  // of a pressure in Pa in the place of kPa
  const double force_N = law.calc_force_N(reference.pressure_Pa, reference.load_N, reference.speed_m_s);
  std::string text = make_origin(coefficients, "%");
  text += "% Block Rolling Resistance (Simscape Driveline), resistance model Pressure and velocity dependent:\n";
  text += "% F = P^alpha N^beta (A + B|v| + C v^2), P in Pa (gauge, as fitted), N and F in N, v in m/s\n";
  text += fmt::format("rolling.tire_pressure = {:.9g};  % Pa\n", reference.pressure_Pa);
  text += fmt::format("rolling.alpha = {:.9g};\nrolling.beta = {:.9g};\n", law.alpha, law.beta);
  text += fmt::format("rolling.A = {:.9g};\n", per_Pa * law.a);
  text += fmt::format("rolling.B = {:.9g};  % s/m\n", per_Pa * kKmhPerMs * law.b);
  text += fmt::format("rolling.C = {:.9g};  % s^2/m^2\n", per_Pa * kKmhPerMs * kKmhPerMs * law.c);
  text += fmt::format("%% Resistance model Constant coefficient, at {}, {:.4g} km/h:\n",
                      describe_condition(coefficients), kKmhPerMs * reference.speed_m_s);
  return text + fmt::format("rolling.constant_coefficient = {:.9g};\n", force_N / reference.load_N);
}

std::string make_fastsim(const RollingCoefficients& coefficients) {
  const double coefficient = coefficients.smerf_N / coefficients.require_reference().load_N;
  return make_origin(coefficients, "#") +
         fmt::format("# mean over the distance of {} at {}, over load\nchassis:\n  wheel_rr_coef: {:.9g}\n",
                     coefficients.cycles, describe_condition(coefficients), coefficient);
}

std::string make_co2mpas(const RollingCoefficients& coefficients, int tires) {
  const estimation::ReferenceCondition& reference = coefficients.require_reference();
  const estimation::J2452Law& law = coefficients.law;
  const double level = tires * std::pow(reference.pressure_Pa / 1e3, law.alpha) * std::pow(reference.load_N, law.beta);
  std::string text = make_origin(coefficients, "#");
  text += fmt::format("# mean over the distance of {} at {}, over load\n", coefficients.cycles,
                      describe_condition(coefficients));
  text += fmt::format("rolling_resistance_coeff: {:.9g}\n", coefficients.smerf_N / reference.load_N);
  text += fmt::format(
      "# share of {} tires in the road load there, without drag and other losses: N, N/(km/h), "
      "N/(km/h)^2\n",
      tires);
  return text + fmt::format("f0: {:.9g}\nf1: {:.9g}\nf2: {:.9g}\n", level * law.a, level * law.b, level * law.c);
}

}  // namespace rollrig::exports
