#include <fmt/format.h>

#include <algorithm>

#include "estimation/road_load/road_load_report.h"
#include "report/fit_pages.h"
#include "report/text.h"
#include "rollrig/fit.h"
#include "sim/core/columns.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

using estimation::CoastdownFile;
using estimation::RoadLoadChecks;
using estimation::RoadLoadFit;

constexpr double kPerKmh = 1.0 / 3.6;

std::string format_forces(const RoadLoadFit& fit) {
  const std::string unit = fit.per_mass ? "m/s2" : "N";
  Table table{"", {"speed, km/h", "force, " + unit, "sd, " + unit, ""}, {}};
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
  return report::format_lines(lines);
}

std::string format_checks(const RoadLoadChecks& checks) {
  std::vector<std::vector<std::string>> rows;
  for (const estimation::RoadLoadCheck& check : checks.checks) {
    rows.push_back({check.name, estimation::name_of(check.status), check.found, check.limit});
  }
  std::string text = "  Checks\n" + text_columns(rows, {false, 4});
  for (const estimation::SessionDrift& drift : checks.drifts) {
    text += wrap(
        fmt::format("drift of coast times over {} runs{}: {:+.1f} % ({:+.1f} to {:+.1f}), {:+.2f} % a run", drift.runs,
                    drift.session.empty() ? "" : " of '" + drift.session + "'", 100.0 * drift.time_change,
                    100.0 * drift.lower_95, 100.0 * drift.upper_95, 100.0 * drift.per_run),
        4);
  }
  return text;
}

std::string format_road_load(const std::string& path, const CoastdownFile& file, const RoadLoadFitOptions& options,
                             const RoadLoadFit& fit, const RoadLoadChecks& checks) {
  std::string text =
      wrap(fmt::format("fit road-load   {} ({})   {}, {}", path, file.is_trace ? "speed trace" : "times through bins",
                       format_count(file.data.runs.size(), "run"), format_count(fit.points.size(), "speed bin")),
           0);
  if (!fit.per_mass) {
    text += fmt::format("  effective mass {:.6g} kg{}\n", fit.effective_mass_kg,
                        options.rotating_mass_kg.has_value() ? "" : ", of which 3 % of the test mass rotate (Assumed)");
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
RoadLoadFit fit_file(const std::string& path, const CoastdownFile& file, const RoadLoadFitOptions& options) {
  try {
    return estimation::fit_road_load(file.data, options);
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (problem.file.empty()) problem.file = path;
    throw InputError(problem);
  }
}

std::vector<ParameterEstimate> list_coefficients(const RoadLoadFit& fit) {
  std::vector<ParameterEstimate> coefficients;
  for (int i = 0; i < 3; ++i) {
    const std::string key = estimation::road_load_key(i, fit.per_mass);
    const auto shown = [i](double value) { return estimation::road_load_in_file_unit(i, value); };
    const std::array<double, 2> interval = fit.interval_95(i);
    coefficients.push_back({key, shown(fit.values()[static_cast<std::size_t>(i)]), shown(fit.sd(i)), shown(interval[0]),
                            shown(interval[1]), unit_of_key(key).symbol});
  }
  return coefficients;
}

}  // namespace

RoadLoad fit_road_load(const std::string& path, const RoadLoadFitOptions& options,
                       const std::vector<std::string>& sessions) {
  const auto file = std::make_shared<CoastdownFile>(estimation::read_coastdowns(path));
  select_sessions(sessions, *file);
  const auto fit = std::make_shared<RoadLoadFit>(fit_file(path, *file, options));
  if (file->rows_off > 0) fit->warnings.push_back(format_count(file->rows_off, "row") + " left out: use = Off");
  const RoadLoadChecks checks = estimation::check_road_load(file->data, *fit);
  RoadLoad result;
  result.coefficients = list_coefficients(*fit);
  result.warnings = fit->warnings;
  result.text = format_road_load(path, *file, options, *fit, checks);
  result.json = to_text(estimation::make_road_load_json(*file, options, *fit, checks));
  result.make_files = [file, fit, json = result.json] {
    return FolderFiles{{"road_load.json", json}, {"residuals.csv", estimation::write_road_load_residuals(*file, *fit)}};
  };
  result.make_page = [file, options, fit, checks] {
    return report::make_html(report::make_road_load_page(*file, options, *fit, checks));
  };
  return result;
}

}  // namespace rollrig
