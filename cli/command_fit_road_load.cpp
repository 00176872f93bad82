#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "estimation/road_load/road_load_report.h"
#include "report/fit_pages.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::cli {
namespace {

using estimation::CheckStatus;
using estimation::CoastdownFile;
using estimation::RoadLoadChecks;
using estimation::RoadLoadFit;
using estimation::RoadLoadFitOptions;

constexpr double kPerKmh = 1.0 / 3.6;

struct Options {
  std::string csv;
  OutputOptions output;
  std::string bounds;
  std::vector<std::string> sessions;
  std::optional<double> mass_kg;
  std::optional<double> rotating_mass_kg;
  std::optional<double> effective_mass_kg;
  std::optional<double> drag_area_m2;
  std::optional<double> speed_to_km_h;
  double speed_from_km_h = 15.0;
  double bin_width_km_h = 5.0;
  double reference_temperature_degC = 20.0;
  double reference_pressure_kPa = 98.21;
  double rolling_fall_per_K = 8.6e-3;
  bool per_mass = false;
};

double parse_edge(const std::string& text, double empty, const std::string& given) {
  if (text.empty()) return empty;
  if (const std::optional<double> value = parse_number(text)) return *value;
  throw usage_error(fmt::format("'{}' is not a number", text), "--bounds", given, "A=from:to,B=from:to,C=from:to");
}

/// "not-negative", or "A=0:300,C=0:" in N, N/(km/h), N/(km/h)^2.
estimation::RoadLoadBounds parse_bounds(const std::string& given) {
  estimation::RoadLoadBounds bounds = estimation::not_negative_bounds();
  if (given == "not-negative") return bounds;
  const double none = std::numeric_limits<double>::infinity();
  bounds.lower = {-none, -none, -none};
  const std::string allowed = "not-negative, or A=from:to,B=from:to,C=from:to, either end left out";
  std::vector<std::string> parts;
  boost::algorithm::split(parts, given, [](char c) { return c == ','; });
  for (const std::string& part : parts) {
    const std::size_t colon = part.find(':');
    const std::size_t which = part.empty() ? std::string::npos : std::string("ABC").find(part[0]);
    if (which == std::string::npos || part.size() < 3 || part[1] != '=' || colon == std::string::npos) {
      throw usage_error(fmt::format("bound '{}' is not understood", part), "--bounds", given, allowed);
    }
    const double unit = unit_of_key(estimation::road_load_key(static_cast<int>(which), false)).factor;
    bounds.lower[which] = unit * parse_edge(part.substr(2, colon - 2), -none, given);
    bounds.upper[which] = unit * parse_edge(part.substr(colon + 1), none, given);
    if (bounds.lower[which] > bounds.upper[which]) {
      throw usage_error(fmt::format("bound '{}' has its ends swapped", part), "--bounds", given, "from <= to");
    }
  }
  return bounds;
}

void set_mass(const Options& options, RoadLoadFitOptions& to) {
  if (options.per_mass) {
    if (options.mass_kg.has_value() || options.effective_mass_kg.has_value() || options.rotating_mass_kg.has_value()) {
      throw usage_error("--per-mass and a mass exclude each other", "--per-mass", "", "one of them");
    }
    return;
  }
  if (!options.mass_kg.has_value()) {
    throw usage_error("the mass is missing: a coastdown alone gives force per mass", "--mass", "",
                      "--mass <kg>, the test mass; or --per-mass for A, B and C per unit of effective mass");
  }
  to.mass_kg = options.mass_kg;
  to.rotating_mass_kg = options.rotating_mass_kg;
  if (!options.effective_mass_kg.has_value()) return;
  if (options.rotating_mass_kg.has_value() || *options.effective_mass_kg < *options.mass_kg) {
    throw usage_error("--effective-mass is test mass and rotating mass together", "--effective-mass",
                      fmt::format("{:.6g}", *options.effective_mass_kg),
                      "at least --mass, and without --rotating-mass");
  }
  to.rotating_mass_kg = *options.effective_mass_kg - *options.mass_kg;
}

RoadLoadFitOptions make_fit_options(const Options& options) {
  RoadLoadFitOptions to;
  set_mass(options, to);
  to.drag_area_m2 = options.drag_area_m2;
  to.reference_temperature_K = options.reference_temperature_degC + kZeroCelsius_K;
  to.reference_pressure_Pa = 1e3 * options.reference_pressure_kPa;
  to.rolling_fall_per_K = options.rolling_fall_per_K;
  to.speed_from_m_s = kPerKmh * options.speed_from_km_h;
  if (options.speed_to_km_h.has_value()) to.speed_to_m_s = kPerKmh * *options.speed_to_km_h;
  to.bin_width_m_s = kPerKmh * options.bin_width_km_h;
  if (options.speed_to_km_h.has_value() && *options.speed_to_km_h <= options.speed_from_km_h) {
    throw usage_error("--speed-to is not above --speed-from", "--speed-to",
                      fmt::format("{:.6g}", *options.speed_to_km_h),
                      fmt::format("more than {:.6g}", options.speed_from_km_h));
  }
  if (!options.bounds.empty()) to.bounds = parse_bounds(options.bounds);
  return to;
}

std::string format_forces(const RoadLoadFit& fit) {
  const std::string unit = fit.per_mass ? "m/s2" : "N";
  scenarios::ResultTable table{"", {"speed, km/h", "force, " + unit, "sd, " + unit, ""}, {}};
  for (const double km_h : {20.0, 50.0, 80.0, 100.0, 130.0}) {
    const double speed = kPerKmh * km_h;
    const bool outside = speed < fit.low_m_s - 0.1 || speed > fit.high_m_s + 0.1;
    table.rows.push_back({fmt::format("{:.0f}", km_h), fmt::format("{:.4g}", fit.force_N(speed)),
                          fmt::format("{:.2g}", fit.force_sd_N(speed)), outside ? "outside the data" : ""});
  }
  return format_table(table);
}

std::string format_scatter(const RoadLoadFit& fit) {
  const std::string unit = fit.per_mass ? "m/s2" : "N";
  std::vector<scenarios::ResultLine> lines;
  const auto add = [&lines](const std::string& label, const std::optional<double>& value, const std::string& symbol) {
    lines.push_back({label, value.has_value() ? fmt::format("{:.3g} {}", *value, symbol) : "not decided by the data"});
  };
  add("scatter of speed", fit.scatter.speed_sd_m_s, "m/s");
  add("scatter along a run", fit.scatter.gust_N_sqrt_s, unit + " sqrt(s)");
  add("scatter from run to run", fit.scatter.run_force_N, unit);
  add("  in proportion to speed", fit.scatter.run_speed_N_s_per_m, unit + " s/m");
  if (fit.scatter.session_force_N.has_value()) {
    add("scatter from session to session", fit.scatter.session_force_N, unit);
  }
  if (fit.slope.has_value()) {
    lines.push_back({"slope, from the headings",
                     fmt::format("{:.3f} +- {:.3f} % uphill in +", 100.0 * *fit.slope, 100.0 * fit.slope_sd)});
  }
  for (const estimation::SessionWind& wind : fit.winds) {
    lines.push_back(
        {"wind, from the headings", fmt::format("{:.2f} +- {:.2f} m/s against +{}", wind.wind_m_s, wind.sd_m_s,
                                                wind.session.empty() ? "" : " '" + wind.session.substr(0, 10) + "'")});
  }
  return format_lines(lines);
}

std::string format_checks(const RoadLoadChecks& checks) {
  std::string text = "  Checks\n";
  for (const estimation::RoadLoadCheck& check : checks.checks) {
    text += fmt::format("    {:<23} {:<12} {:<23} {}\n", check.name, estimation::name_of(check.status), check.found,
                        check.limit);
  }
  for (const estimation::SessionDrift& drift : checks.drifts) {
    text += wrap(
        fmt::format("drift of coast times over {} runs{}: {:+.1f} % ({:+.1f} to {:+.1f}), {:+.2f} % a run", drift.runs,
                    drift.session.empty() ? "" : " of '" + drift.session + "'", 100.0 * drift.time_change,
                    100.0 * drift.lower_95, 100.0 * drift.upper_95, 100.0 * drift.per_run),
        4);
  }
  return text;
}

std::string format_fit(const Options& options, const CoastdownFile& file, const RoadLoadFit& fit,
                       const RoadLoadChecks& checks) {
  std::string text = wrap(
      fmt::format("fit road-load   {} ({})   {}, {}", options.csv, file.is_trace ? "speed trace" : "times through bins",
                  format_count(file.data.runs.size(), "run"), format_count(fit.points.size(), "speed bin")),
      0);
  if (!fit.per_mass) {
    text += fmt::format("  effective mass {:.6g} kg{}\n", fit.effective_mass_kg,
                        options.rotating_mass_kg.has_value() || options.effective_mass_kg.has_value()
                            ? ""
                            : ", of which 3 % of the test mass rotate (Assumed)");
  }
  text += format_table(
      report::make_coefficient_table(fit, "At reference conditions, with standard deviation and 95 % interval"));
  text += format_forces(fit) + format_scatter(fit) + format_checks(checks);
  for (const std::string& warning : fit.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

/// Keeps the runs of the sessions that were asked for.
void select_sessions(const std::vector<std::string>& wanted, CoastdownFile& file) {
  if (wanted.empty()) return;
  std::vector<std::string> known;
  for (const estimation::CoastdownRun& run : file.data.runs) {
    if (std::find(known.begin(), known.end(), run.session) == known.end()) known.push_back(run.session);
  }
  for (const std::string& session : wanted) {
    if (std::find(known.begin(), known.end(), session) != known.end()) continue;
    InputProblem problem = unknown_name("session", session, known);
    problem.file = "command line";
    problem.key = "--session";
    throw InputError(problem);
  }
  auto& runs = file.data.runs;
  const auto unwanted = [&wanted](const estimation::CoastdownRun& run) {
    return std::find(wanted.begin(), wanted.end(), run.session) == wanted.end();
  };
  runs.erase(std::remove_if(runs.begin(), runs.end(), unwanted), runs.end());
}

/// The fit, its InputErrors with the file's name.
RoadLoadFit fit_file(const CoastdownFile& file, const Options& options, const RoadLoadFitOptions& fit_options) {
  try {
    return estimation::fit_road_load(file.data, fit_options);
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (problem.file.empty()) problem.file = options.csv;
    throw InputError(problem);
  }
}

int fit_road_load_command(const Options& options) {
  const RoadLoadFitOptions fit_options = make_fit_options(options);
  CoastdownFile file = estimation::read_coastdowns(options.csv);
  select_sessions(options.sessions, file);
  Output output(options.output);
  RoadLoadFit fit = fit_file(file, options, fit_options);
  if (file.rows_off > 0) fit.warnings.push_back(format_count(file.rows_off, "row") + " left out: use = Off");
  const RoadLoadChecks checks = estimation::check_road_load(file.data, fit);
  const std::string json = to_text(estimation::make_road_load_json(file, fit_options, fit, checks));
  output.write({{"road_load.json", json}, {"residuals.csv", estimation::write_road_load_residuals(file, fit)}}, json,
               [&] { return report::make_road_load_page(file, fit_options, fit, checks); });
  output.print(format_fit(options, file, fit, checks));
  return kDone;
}

void add_vehicle_options(CLI::App& command, Options& options) {
  command.add_option("--mass", options.mass_kg, "Test mass, kg")->check(CLI::PositiveNumber);
  command.add_option("--rotating-mass", options.rotating_mass_kg, "Mass that rotates, kg [3 % of --mass]")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--effective-mass", options.effective_mass_kg, "Both together, kg")->check(CLI::PositiveNumber);
  command.add_flag("--per-mass", options.per_mass, "A, B, C per unit of effective mass; no mass needed");
  command.add_option("--drag-area", options.drag_area_m2, "Cd A that the wind acts on, m2 [from C]")
      ->check(CLI::PositiveNumber);
}

void add_method_options(CLI::App& command, Options& options) {
  command.add_option("--reference-temperature", options.reference_temperature_degC, "degC [20]")
      ->check(CLI::Range(-50.0, 60.0));
  command.add_option("--reference-pressure", options.reference_pressure_kPa, "Sets the air density, kPa [98.21]")
      ->check(CLI::Range(50.0, 110.0));
  command
      .add_option("--rolling-coefficient-temperature", options.rolling_fall_per_K,
                  "Fall of A and B with ambient, per K [0.0086]")
      ->check(CLI::Range(0.0, 0.05));
  command.add_option("--speed-from", options.speed_from_km_h, "Lowest speed used, km/h [15]")
      ->check(CLI::Range(0.0, 500.0));
  command.add_option("--speed-to", options.speed_to_km_h, "Highest speed used, km/h")->check(CLI::Range(1.0, 500.0));
  command.add_option("--bin-width", options.bin_width_km_h, "Of the bins that a trace is cut into, km/h [5]")
      ->check(CLI::Range(1.0, 50.0));
  command.add_option("--session", options.sessions, "Sessions used [all]");
  command.add_option("--bounds", options.bounds, "not-negative, or as A=0:300,B=-1:,C=0: in N and km/h [none]");
}

}  // namespace

void add_fit_road_load(CLI::App& fit, Action& action) {
  const auto [command, options] = add_command<Options>(
      fit, action, "road-load", "A, B, C from coastdowns on a road or a dyno", &fit_road_load_command);
  command->add_option("csv", options->csv, "Speed traces, or times through speed bins")->required();
  add_vehicle_options(*command, *options);
  add_method_options(*command, *options);
  options->output.add_to(*command, "File for road_load.json, - for standard output",
                         "Folder for road_load.json and residuals.csv");
}

}  // namespace rollrig::cli
