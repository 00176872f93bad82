#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/uncertain_result.h"
#include "rollrig/fit.h"
#include "rollrig/road_load.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::cli {
namespace {

constexpr double kPerKmh = 1.0 / 3.6;
constexpr const char* kKeys[]{"A_N", "B_N_per_km_h", "C_N_per_km_h2"};  // whose units coefficients have
constexpr const char* kNames[]{"A", "B", "C", "f0", "f1", "f2"};        // in N and km/h
constexpr const char* kNamesLbf[]{"A_lbf", "B_lbf", "C_lbf"};           // in lbf and mph

constexpr const char* kOwnMethod = "least-squares";

struct NamedProcedure {
  const char* method;  // of --method
  RoadLoadProcedureKind kind;
};
constexpr NamedProcedure kProcedures[]{{"wltp", RoadLoadProcedureKind::kWltp},
                                       {"j2263", RoadLoadProcedureKind::kJ2263},
                                       {"j1263", RoadLoadProcedureKind::kJ1263},
                                       {"torque-meter", RoadLoadProcedureKind::kTorqueMeter}};

/// nullptr for the method of least squares.
const NamedProcedure* find_procedure(const std::string& method) {
  const auto* found = std::find_if(std::begin(kProcedures), std::end(kProcedures),
                                   [&](const NamedProcedure& one) { return method == one.method; });
  return found == std::end(kProcedures) ? nullptr : found;
}

std::vector<std::string> list_methods() {
  std::vector<std::string> methods{kOwnMethod};
  for (const NamedProcedure& one : kProcedures) methods.emplace_back(one.method);
  return methods;
}

struct FitRoadLoadOptions {
  std::string csv;
  OutputOptions output;
  std::string bounds;
  std::string target;
  std::vector<std::string> leave_out;
  std::vector<std::string> sessions;
  std::optional<double> mass_kg;
  std::optional<double> rotating_mass_kg;
  std::optional<double> effective_mass_kg;
  std::optional<double> drag_area_m2;
  std::optional<double> speed_to_km_h;
  double speed_from_km_h = 15.0;
  double bin_width_km_h = 5.0;
  double reference_temperature_degC = 20.0;
  std::optional<double> reference_pressure_kPa;
  double rolling_fall_per_K = 8.6e-3;
  std::string method = kOwnMethod;
  std::optional<double> corrected_mass_kg;
  std::optional<double> wheel_radius_m;
  std::optional<int> yaw_degree;
  bool per_mass = false;
  BadRows bad_rows = BadRows::kRefuse;
  UncertaintyOptions uncertainty;
};

/// A coefficient by its name, with the factor of its unit.
struct NamedCoefficient {
  std::size_t which = 0;
  double unit_SI = 1.0;
};

/// "A" and "f0" in N and km/h, "A_lbf" in lbf and mph; none for another name.
std::optional<NamedCoefficient> find_coefficient(const std::string& name) {
  for (std::size_t i = 0; i < 6; ++i) {
    if (name == kNames[i]) return NamedCoefficient{i % 3, unit_of_key(kKeys[i % 3]).factor};
    if (i < 3 && name == kNamesLbf[i]) return NamedCoefficient{i, kPoundForce_N / std::pow(kMph_m_s, i)};
  }
  return std::nullopt;
}

/// "A=120,B=0.5,C=0.03", f0, f1, f2, or A_lbf, B_lbf, C_lbf.
std::array<double, 3> parse_target(const std::string& given) {
  const std::string allowed = "A, B, C or f0, f1, f2 in N and km/h, or A_lbf, B_lbf, C_lbf, as A=120,B=0.5,C=0.03";
  std::array<double, 3> target{};
  std::array<int, 3> counts{};
  std::vector<std::string> parts;
  boost::algorithm::split(parts, given, [](char c) { return c == ','; });
  for (const std::string& part : parts) {
    const std::size_t equals = part.find('=');
    const auto coefficient = find_coefficient(part.substr(0, equals));
    const auto value = equals == std::string::npos ? std::nullopt : parse_number(part.substr(equals + 1));
    if (!coefficient.has_value() || !value.has_value()) {
      throw usage_error(fmt::format("target '{}' is not understood", part), "--target", given, allowed);
    }
    target[coefficient->which] = coefficient->unit_SI * *value;
    ++counts[coefficient->which];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 1) continue;
    throw usage_error(fmt::format("the target has {} {}", kNames[i], counts[i] == 0 ? "missing" : "more than once"),
                      "--target", given, allowed);
  }
  return target;
}

double parse_edge(const std::string& text, double empty, const std::string& given) {
  if (text.empty()) return empty;
  if (const std::optional<double> value = parse_number(text)) return *value;
  throw usage_error(fmt::format("'{}' is not a number", text), "--bounds", given, "A=from:to,B=from:to,C=from:to");
}

/// "not-negative", or "A=0:300,C=0:" in N, N/(km/h), N/(km/h)^2, or with f0, f1, f2, or "A_lbf=0:60" in lbf and mph.
RoadLoadBounds parse_bounds(const std::string& given) {
  RoadLoadBounds bounds;
  if (given == "not-negative") return bounds;
  const double none = std::numeric_limits<double>::infinity();
  bounds.lower = {-none, -none, -none};
  const std::string allowed =
      "not-negative, or A=from:to,B=from:to,C=from:to, either end left out; f0, f1, f2 are A, B, C, and A_lbf, B_lbf, "
      "C_lbf are in lbf and mph";
  std::vector<std::string> parts;
  boost::algorithm::split(parts, given, [](char c) { return c == ','; });
  for (const std::string& part : parts) {
    const std::size_t colon = part.find(':');
    const std::size_t equals = part.find('=');
    const auto coefficient = find_coefficient(part.substr(0, equals));
    if (!coefficient.has_value() || equals == std::string::npos || colon == std::string::npos || colon < equals) {
      throw usage_error(fmt::format("bound '{}' is not understood", part), "--bounds", given, allowed);
    }
    const auto [which, unit] = *coefficient;
    bounds.lower[which] = unit * parse_edge(part.substr(equals + 1, colon - equals - 1), -none, given);
    bounds.upper[which] = unit * parse_edge(part.substr(colon + 1), none, given);
  }
  return bounds;
}

void set_mass(const FitRoadLoadOptions& options, RoadLoadFitOptions& to) {
  if (options.per_mass) {
    if (options.mass_kg.has_value() || options.effective_mass_kg.has_value() || options.rotating_mass_kg.has_value()) {
      throw usage_error("--per-mass and a mass exclude each other", "--per-mass", "", "one of them");
    }
    return;
  }
  to.mass_kg = options.mass_kg;
  to.rotating_mass_kg = options.rotating_mass_kg;
  to.recorded_vehicle = !options.mass_kg.has_value();  // a recording tells it; of any other file it is missing
  if (!options.effective_mass_kg.has_value()) return;
  if (!options.mass_kg.has_value()) {
    throw usage_error("--effective-mass is given without the mass as tested", "--effective-mass",
                      fmt::format("{:.6g}", *options.effective_mass_kg), "--mass <kg> beside it, or none of them");
  }
  if (options.rotating_mass_kg.has_value() || *options.effective_mass_kg < *options.mass_kg) {
    throw usage_error("--effective-mass is mass as tested and rotating mass together", "--effective-mass",
                      fmt::format("{:.6g}", *options.effective_mass_kg),
                      "at least --mass, and without --rotating-mass");
  }
  to.rotating_mass_kg = *options.effective_mass_kg - *options.mass_kg;
}

RoadLoadFitOptions make_fit_options(const FitRoadLoadOptions& options) {
  RoadLoadFitOptions to;
  set_mass(options, to);
  to.drag_area_m2 = options.drag_area_m2;
  to.reference_temperature_K = options.reference_temperature_degC + kZeroCelsius_K;
  if (options.reference_pressure_kPa.has_value()) to.reference_pressure_Pa = 1e3 * *options.reference_pressure_kPa;
  to.rolling_fall_per_K = options.rolling_fall_per_K;
  to.speed_from_m_s = kPerKmh * options.speed_from_km_h;
  if (options.speed_to_km_h.has_value()) to.speed_to_m_s = kPerKmh * *options.speed_to_km_h;
  to.bin_width_m_s = kPerKmh * options.bin_width_km_h;
  if (!options.bounds.empty()) to.bounds = parse_bounds(options.bounds);
  if (!options.target.empty()) to.target = parse_target(options.target);
  to.leave_out = options.leave_out;
  return to;
}

/// Refuses what another method has options for.
void require_options_of(bool procedure, const FitRoadLoadOptions& options) {
  const auto refuse = [&options](bool given, const char* option, const char* allowed) {
    if (given) {
      throw usage_error(fmt::format("{} has no meaning with --method {}", option, options.method), option, "", allowed);
    }
  };
  if (!procedure) {
    refuse(options.corrected_mass_kg.has_value(), "--corrected-mass", "--method wltp or torque-meter beside it");
    refuse(options.wheel_radius_m.has_value(), "--wheel-radius", "--method torque-meter beside it");
    refuse(options.yaw_degree.has_value(), "--yaw-degree", "--method j2263 beside it");
    return;
  }
  constexpr const char* kOwnAlone = "--method least-squares";
  refuse(options.per_mass, "--per-mass", kOwnAlone);
  refuse(options.drag_area_m2.has_value(), "--drag-area", kOwnAlone);
  refuse(!options.bounds.empty(), "--bounds", kOwnAlone);
  refuse(!options.target.empty(), "--target", kOwnAlone);
  refuse(options.bin_width_km_h != FitRoadLoadOptions().bin_width_km_h, "--bin-width", kOwnAlone);
  refuse(options.yaw_degree.has_value() && options.method != "j2263", "--yaw-degree", "--method j2263 beside it");
  refuse(options.wheel_radius_m.has_value() && options.method != "torque-meter", "--wheel-radius",
         "--method torque-meter beside it");
}

RoadLoadProcedureOptions make_procedure_options(const FitRoadLoadOptions& options, RoadLoadProcedureKind kind) {
  RoadLoadFitOptions masses;
  set_mass(options, masses);
  RoadLoadProcedureOptions to;
  to.kind = kind;
  to.mass_kg = masses.mass_kg;
  to.rotating_mass_kg = masses.rotating_mass_kg;
  to.corrected_to_mass_kg = options.corrected_mass_kg;
  to.reference_temperature_K = options.reference_temperature_degC + kZeroCelsius_K;
  if (options.reference_pressure_kPa.has_value()) to.reference_pressure_Pa = 1e3 * *options.reference_pressure_kPa;
  to.rolling_fall_per_K = options.rolling_fall_per_K;
  to.speed_from_m_s = kPerKmh * options.speed_from_km_h;
  if (options.speed_to_km_h.has_value()) to.speed_to_m_s = kPerKmh * *options.speed_to_km_h;
  if (options.yaw_degree.has_value()) to.yaw_degree = *options.yaw_degree;
  to.wheel_radius_m = options.wheel_radius_m;
  to.leave_out = options.leave_out;
  return to;
}

int fit_road_load_command(const FitRoadLoadOptions& options) {
  const NamedProcedure* procedure = find_procedure(options.method);
  require_options_of(procedure != nullptr, options);
  const auto fit = [&](const UncertaintyOptions& uncertainty, const Progress& progress) {
    if (procedure == nullptr) {
      return fit_road_load(options.csv, make_fit_options(options), options.sessions, options.bad_rows, uncertainty,
                           progress);
    }
    return evaluate_road_load(options.csv, make_procedure_options(options, procedure->kind), options.sessions,
                              options.bad_rows, uncertainty, progress);
  };
  Output output(options.output);
  output.show(make_uncertain("fit road-load", options.output, options.uncertainty, fit));
  return kDone;
}

struct DefaultRoadLoadCommandOptions {
  DefaultRoadLoadOptions load;
  OutputOptions output;
};

int default_road_load_command(const DefaultRoadLoadCommandOptions& options) {
  Output output(options.output);
  output.show(calc_default_road_load(options.load));
  return kDone;
}

void add_vehicle_options(CLI::App& command, FitRoadLoadOptions& options) {
  const CLI::Validator kMassRange = shown_range(100.0, 1e6);  // Assumed: from a motorcycle to a dump truck
  command.add_option("--mass", options.mass_kg, "Mass as tested, kg")->check(kMassRange);
  command.add_option("--rotating-mass", options.rotating_mass_kg, "Mass that rotates, kg [3 % of --mass]")
      ->check(shown_range(0.0, 1e6));
  command.add_option("--effective-mass", options.effective_mass_kg, "Both together, kg")->check(kMassRange);
  command.add_flag("--per-mass", options.per_mass, "A, B, C per unit of effective mass; no mass needed");
  command.add_option("--drag-area", options.drag_area_m2, "Cd A that the wind acts on, m2 [from C]")
      ->check(shown_range(0.01, 1000.0));
}

void add_procedure_options(CLI::App& command, FitRoadLoadOptions& options) {
  command
      .add_option("--method", options.method,
                  "least-squares, or by a procedure: wltp (coastdown times), j2263 (traces with anemometer), j1263 "
                  "(mean wind), torque-meter [least-squares]")
      ->check(CLI::IsMember(list_methods()));
  command
      .add_option("--corrected-mass", options.corrected_mass_kg,
                  "Test mass TM to which a procedure corrects f0, kg [--mass]")
      ->check(shown_range(100.0, 1e6));
  command
      .add_option("--wheel-radius", options.wheel_radius_m,
                  "Dynamic radius of the torque-meter method, m [from the column wheel_speed_Hz]")
      ->check(shown_range(0.1, 2.0));
  command.add_option("--yaw-degree", options.yaw_degree, "Of the drag area of j2263 by yaw angle [2]")
      ->check(shown_range(0, 4));
}

void add_method_options(CLI::App& command, FitRoadLoadOptions& options) {
  command.add_option("--reference-temperature", options.reference_temperature_degC, "degC [20]")
      ->check(shown_range(-50.0, 60.0));
  command
      .add_option("--reference-pressure", options.reference_pressure_kPa,
                  "Sets the air density, kPa [98.21; 100 of WLTP]")
      ->check(shown_range(50.0, 110.0));
  command
      .add_option("--rolling-coefficient-temperature", options.rolling_fall_per_K,
                  "Fall of A and B with ambient, per K [0.0086]")
      ->check(shown_range(0.0, 0.05));
  command.add_option("--speed-from", options.speed_from_km_h, "Lowest speed used, km/h [15]")
      ->check(shown_range(0.0, 500.0));
  command.add_option("--speed-to", options.speed_to_km_h, "Highest speed used, km/h")->check(shown_range(1.0, 500.0));
  command
      .add_option("--bin-width", options.bin_width_km_h, "Width of the speed bins that a trace is cut into, km/h [5]")
      ->check(shown_range(1.0, 50.0));
  command.add_option("--session", options.sessions, "Sessions used [all]");
  command.add_option("--leave-out", options.leave_out, "Runs that are not used, as 7 or session/7 [none]");
  command.add_option("--bounds", options.bounds,
                     "not-negative, or as A=0:300,B=-1:,C=0: in N and km/h, A_lbf=0:60 in lbf and mph [none]");
  command.add_option("--target", options.target,
                     "A=..,B=..,C=.. (or f0, f1, f2; A_lbf, B_lbf, C_lbf) to compare with [none]");
}

}  // namespace

void add_fit_road_load(CLI::App& fit, Action& action) {
  const auto [command, options] = add_command<FitRoadLoadOptions>(
      fit, action, "road-load", "A, B, C from coastdowns on a road or a dyno", &fit_road_load_command);
  command
      ->add_option("csv", options->csv,
                   "Speed traces, times through speed bins, or what rollrig run coastdown --out wrote")
      ->required();
  add_vehicle_options(*command, *options);
  add_procedure_options(*command, *options);
  add_method_options(*command, *options);
  options->output.add_to(*command, "File for road_load.json, - for standard output",
                         "Folder for road_load.json and residuals.csv (points.csv)");
  options->output.add_report_to(*command);
  add_uncertainty_options(*command, options->uncertainty, true);
  add_skip_bad_rows(*command, options->bad_rows);
}

void add_fit_default_road_load(CLI::App& fit, Action& action) {
  const auto [command, options] = add_command<DefaultRoadLoadCommandOptions>(
      fit, action, "default-road-load", "Default road load of the WLTP, without a measurement",
      &default_road_load_command);
  command->add_option("--mass", options->load.mass_kg, "Test mass TM, kg")->required()->check(shown_range(100.0, 1e6));
  command->add_option("--width", options->load.width_m, "Width of the vehicle, m")
      ->required()
      ->check(shown_range(0.5, 5.0));
  command->add_option("--height", options->load.height_m, "Height of the vehicle, m")
      ->required()
      ->check(shown_range(0.5, 5.0));
  command->add_option("--tire-class", options->load.tire_class, "C1, C2 or C3 [none]");
  command->add_option("--rrc", options->load.rrc_N_per_kN, "Rolling resistance of that tire, for its class, N/kN")
      ->check(shown_range(1.0, 30.0));
  options->output.add_to(*command, "File for road_load.json, - for standard output", "Folder for road_load.json");
}

}  // namespace rollrig::cli
