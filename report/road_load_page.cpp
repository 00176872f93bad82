#include <fmt/format.h>

#include <optional>
#include <utility>

#include "estimation/road_load/road_load_report.h"
#include "report/blocks.h"
#include "report/fit_pages.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using estimation::RoadLoadFit;
using estimation::RoadLoadPoint;

std::string force_unit(const RoadLoadFit& fit) { return fit.per_mass ? "m/s2" : "N"; }

/// A, B, C with intervals; what stands on a limit, or whose interval was cut there, is marked.
Table make_coefficient_table(const std::string& title, const RoadLoadFit& fit,
                             const std::vector<ParameterEstimate>& coefficients) {
  constexpr const char* kNames[] = {"A, f0", "B, f1", "C, f2"};
  const auto number = [](double value) { return fmt::format("{:.5g}", value); };
  Table table{title, {"", "value", "sd", "from", "to", "unit", ""}, {}};
  for (int i = 0; i < 3; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ParameterEstimate& at = coefficients[index];
    const bool on_limit = fit.on_bound[index];
    table.rows.push_back({kNames[i], number(at.value), on_limit ? "-" : fmt::format("{:.3g}", at.sd), number(at.low_95),
                          number(at.high_95), at.unit,
                          on_limit        ? "on its limit"
                          : fit.is_cut(i) ? "cut at its limit"
                                          : ""});
  }
  return table;
}

std::vector<Table> make_coefficients(const RoadLoadFit& fit) {
  std::vector<Table> tables{make_coefficient_table("At reference conditions, with standard deviation and 95 % interval",
                                                   fit, estimation::list_coefficients(fit))};
  if (!fit.per_mass) {
    tables.push_back(make_coefficient_table("In lbf and mph", fit, estimation::list_coefficients_lbf_mph(fit)));
  }
  if (fit.others != nullptr) {
    tables.push_back(make_coefficient_table("Without the runs in doubt (see the warnings)", *fit.others,
                                            estimation::list_coefficients(*fit.others)));
  }
  return tables;
}

Table make_target(const RoadLoadFitOptions& options) {
  Table table{"Target", {"", "N, km/h", "lbf, mph"}, {}};
  constexpr const char* kNames[] = {"A, f0", "B, f1", "C, f2"};
  for (int i = 0; i < 3; ++i) {
    const double value = (*options.target)[static_cast<std::size_t>(i)];
    table.rows.push_back({kNames[i], fmt::format("{:.5g}", estimation::road_load_in_file_unit(i, value)),
                          fmt::format("{:.5g}", estimation::road_load_in_lbf_mph(i, value))});
  }
  return table;
}

Table make_forces(const RoadLoadFitOptions& options, const RoadLoadFit& fit) {
  const std::string unit = force_unit(fit);
  const bool compares = options.target.has_value();
  Table table{"", {"speed, km/h", "force, " + unit, "sd, " + unit}, {}};
  if (compares) table.columns.insert(table.columns.end(), {"target, N", "over target"});
  table.columns.push_back("");
  for (const estimation::ShownForce& at : estimation::list_shown_forces(options, fit)) {
    std::vector<std::string> row{fmt::format("{:.0f}", kKmhPerMs * at.speed_m_s), fmt::format("{:.4g}", at.force_N),
                                 fmt::format("{:.2g}", at.sd_N)};
    if (at.target_N.has_value()) {
      row.push_back(fmt::format("{:.4g}", *at.target_N));
      row.push_back(fmt::format("{:+.1f} %", at.calc_over_target_percent()));
    }
    row.push_back(at.is_outside ? "outside the data" : "");
    table.rows.push_back(row);
  }
  return table;
}

/// How the runs scatter and drift, and what their headings tell of slope and wind.
Table make_scatter(const RoadLoadFit& fit, const estimation::RoadLoadChecks& checks) {
  const std::string unit = force_unit(fit);
  Table list;
  const auto add = [&list](const std::string& label, const std::optional<double>& value, const std::string& symbol) {
    list.rows.push_back(
        {label, value.has_value() ? fmt::format("{:.3g} {}", *value, symbol) : "not decided by the data"});
  };
  add("scatter of speed", fit.scatter.speed_sd_m_s, "m/s");
  add("scatter along a run", fit.scatter.gust_N_sqrt_s, unit + " sqrt(s)");
  add("scatter from run to run", fit.scatter.run_force_N, unit);
  add("  in proportion to speed", fit.scatter.run_speed_N_s_per_m, unit + " s/m");
  if (fit.scatter.session_force_N.has_value()) {
    add("scatter from session to session, at all speeds", fit.scatter.session_force_N, unit);
  }
  if (fit.scatter.session_share.has_value()) {
    add("scatter from session to session", 100.0 * *fit.scatter.session_share, "% of the force");
  }
  if (fit.slope.has_value()) {
    list.rows.push_back({"slope, from the headings", fmt::format("{:.3f} +- {:.3f} % uphill in +",
                                                                 100.0 * *fit.slope + 0.0, 100.0 * fit.slope_sd)});
  }
  for (const estimation::SessionWind& wind : fit.winds) {
    list.rows.push_back(
        {"wind, from the headings", fmt::format("{:.2f} +- {:.2f} m/s against +{}", wind.wind_m_s, wind.sd_m_s,
                                                wind.session.empty() ? "" : " '" + wind.session.substr(0, 10) + "'")});
  }
  for (const estimation::SessionDrift& drift : checks.drifts) {
    list.rows.push_back(
        {"drift of coast times",
         fmt::format("{:+.1f} % ({:+.1f} to {:+.1f}) over {} runs{}, {:+.2f} % a run", 100.0 * drift.time_change,
                     100.0 * drift.lower_95, 100.0 * drift.upper_95, drift.runs,
                     drift.session.empty() ? "" : " of '" + drift.session + "'", 100.0 * drift.per_run)});
  }
  return list;
}

Table make_checks(const estimation::RoadLoadChecks& checks) {
  Table table{"Checks: what the standards ask of coastdowns", {"check", "", "found", "limit", "clause"}, {}, 1};
  for (const estimation::RoadLoadCheck& check : checks.checks) {
    table.rows.push_back({check.name, estimation::name_of(check.status), check.found, check.limit, check.clause});
  }
  return table;
}

Block make_load_tiles(const RoadLoadFitOptions& options, const RoadLoadFit& fit) {
  constexpr const char* kSymbols[] = {"A", "B", "C"};
  constexpr const char* kNotes[] = {"force at standstill", "rise with speed", "rise with the square of speed"};
  const std::vector<ParameterEstimate> coefficients = estimation::list_coefficients(fit);
  std::vector<Tile> tiles;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const ParameterEstimate& at = coefficients[i];
    const std::string value = fmt::format("{:.4g}", at.value);
    tiles.push_back({kSymbols[i],
                     fit.on_bound[i] ? value : fmt::format("{} +- {:.2g}", value, at.sd),
                     at.unit,
                     fit.on_bound[i] ? "on its limit" : kNotes[i],
                     "",
                     {"/" + at.name, "/" + at.name + "_sd"}});
    if (fit.on_bound[i]) tiles.back().from.pop_back();
  }
  constexpr std::size_t kAt80 = 2;  // of shown_speeds_m_s()
  const estimation::ShownForce at_80 = estimation::list_shown_forces(options, fit)[kAt80];
  if (!at_80.is_outside) {
    const std::string place = fmt::format("/forces/{}/force_{}", kAt80, fit.per_mass ? "m_s2" : "N");
    tiles.insert(tiles.begin(), {"Road load at 80 km/h",
                                 show_with_sd(at_80.force_N, at_80.sd_N),
                                 force_unit(fit),
                                 "at reference conditions; +- is one standard deviation, in all these tiles",
                                 "",
                                 {place, place + "_sd"}});
  }
  return make_tiles(tiles);
}

/// The road load in a sentence.
Block make_load_lead(const RoadLoadFitOptions& options, const RoadLoadFit& fit) {
  const std::vector<ParameterEstimate> coefficients = estimation::list_coefficients(fit);
  const auto show = [&](std::size_t i) {
    return fmt::format("{:.4g} {}", coefficients[i].value, coefficients[i].unit);
  };
  constexpr std::size_t kAt80 = 2;  // of shown_speeds_m_s()
  const estimation::ShownForce at_80 = estimation::list_shown_forces(options, fit)[kAt80];
  const std::string start = at_80.is_outside
                                ? std::string("The road load at reference conditions is A + B v + C v²")
                                : fmt::format("The road load at 80 km/h is {} {} (one standard deviation) at reference conditions",
                                              show_with_sd(at_80.force_N, at_80.sd_N), force_unit(fit));
  return make_lead("", fmt::format("{}: A = {}, B = {}, C = {}.", start, show(0), show(1), show(2)));
}

/// Speed over time of every run, each from its own start; none where the file has times through bins alone.
Block make_run_chart(const estimation::CoastdownFile& file) {
  constexpr std::size_t kMost = 300;  // points of a line: more than it has bends
  Json series = Json::array();
  for (const estimation::CoastdownRun& run : file.data.runs) {
    ChartSeries line;
    for (const std::size_t row : thin(run.time_s, run.speed_m_s, kMost)) {
      line.add(run.time_s[row] - run.time_s.front(), kKmhPerMs * run.speed_m_s[row]);
    }
    series.push_back(line.finish(run.id, "line"));
  }
  return make_curves({"Time since the start of the run", "s"}, {"Speed", "km/h", true}, series);
}

/// Time through each bin over speed, per km/h of its width, since bins may have several widths.
Block make_time_chart(const estimation::CoastdownFile& file, const RoadLoadFit& fit) {
  Json series = Json::array();
  for (std::size_t run = 0; run < file.data.runs.size(); ++run) {
    ChartSeries points;
    for (const RoadLoadPoint& at : fit.points) {
      if (at.run != run) continue;
      points.add(kKmhPerMs * 0.5 * (at.high_m_s + at.low_m_s),
                 at.duration_s / (kKmhPerMs * (at.high_m_s - at.low_m_s)));
    }
    if (!points.x.empty()) series.push_back(points.finish(file.data.runs[run].id));
  }
  return make_curves({"Middle of the speed bin", "km/h"}, {"Time through the bin", "s per km/h", true}, series,
                     "Runs that lie together say the same.");
}

/// The fitted curve with its interval over the speeds that the data cover.
Json make_load_curve(const RoadLoadFit& fit) {
  constexpr int kPoints = 40;
  constexpr double kWide = 1.96;  // of a normal interval of 95 %
  ChartSeries curve;
  for (int i = 0; i <= kPoints; ++i) {
    const double speed_m_s = fit.low_m_s + (fit.high_m_s - fit.low_m_s) * i / kPoints;
    const double force_N = fit.force_N(speed_m_s);
    const double half_N = kWide * fit.force_sd_N(speed_m_s);
    curve.add(kKmhPerMs * speed_m_s, force_N, force_N - half_N, force_N + half_N);
  }
  return curve.finish("A + B v + C v² at reference conditions, 95 % band", "line");
}

/// A series for each heading; `value` is what is shown of a point.
void add_headings(const estimation::CoastdownFile& file, const RoadLoadFit& fit, double RoadLoadPoint::*value,
                  Json& series) {
  for (const auto& [heading, name] : {std::pair(1, "runs in + heading"), {-1, "runs in - heading"}, {0, "runs"}}) {
    ChartSeries points;
    for (const RoadLoadPoint& point : fit.points) {
      if (file.data.runs[point.run].heading == heading) points.add(kKmhPerMs * point.speed_m_s, point.*value);
    }
    if (!points.x.empty()) series.push_back(points.finish(name));
  }
}

Block make_force_chart(const estimation::CoastdownFile& file, const RoadLoadFit& fit) {
  Json series = Json::array({make_load_curve(fit)});
  add_headings(file, fit, &RoadLoadPoint::force_N, series);
  return make_curves({"Speed", "km/h"}, {fit.per_mass ? "Deceleration" : "Force", force_unit(fit), true}, series,
                     "Points: mean force over a speed bin as tested, with that run's wind, slope and weather.");
}

Block make_road_residual_chart(const estimation::CoastdownFile& file, const RoadLoadFit& fit) {
  Json series = Json::array();
  add_headings(file, fit, &RoadLoadPoint::residual_N, series);
  Block block = make_curves({"Speed", "km/h"}, {"Measured minus fitted", force_unit(fit)}, series,
                            "Fit as tested: wind, slope and weather are in it.");
  block["marks"] = {0.0};
  return block;
}

}  // namespace

std::vector<Table> make_road_load_tables(const RoadLoadFitOptions& options, const RoadLoadFit& fit,
                                         const estimation::RoadLoadChecks& checks) {
  Table masses;
  if (!fit.per_mass) {
    const char* assumed =
        options.rotating_mass_kg.has_value() ? "" : ", of which 3 % of the mass as tested rotate (Assumed)";
    masses.rows.push_back({"effective mass", fmt::format("{:.6g} kg{}", fit.effective_mass_kg, assumed)});
  }
  std::vector<Table> tables{masses};
  for (const Table& coefficients : make_coefficients(fit)) tables.push_back(coefficients);
  if (options.target.has_value()) tables.push_back(make_target(options));
  tables.insert(tables.end(), {make_forces(options, fit), make_scatter(fit, checks), make_checks(checks)});
  return tables;
}

Page make_road_load_page(const estimation::CoastdownFile& file, const RoadLoadFitOptions& options,
                         const RoadLoadFit& fit, const estimation::RoadLoadChecks& checks) {
  Page page{"fit road-load", "Road load from coastdowns",
            fmt::format("{}, {}, {}", format_count(file.data.runs.size(), "run"),
                        format_count(fit.points.size(), "speed bin"),
                        file.is_trace ? "from speed traces" : "from times through bins")};
  Section result = make_section("Result", make_road_load_tables(options, fit, checks), fit.warnings);
  put_first({make_load_lead(options, fit), make_load_tiles(options, fit), make_force_chart(file, fit)}, result);
  page.add(std::move(result));
  Section runs{"Runs"};
  if (file.is_trace) runs.blocks.push_back(make_run_chart(file));
  runs.blocks.push_back(make_time_chart(file, fit));
  page.add({"Law of the road load", "", {make_equations("coastdown")}});
  page.add(std::move(runs));
  page.add({"Residuals", "", {make_road_residual_chart(file, fit)}});
  page.add(make_document(estimation::make_road_load_json(file, options, fit, checks), "The fit as JSON"));
  return page;
}

}  // namespace rollrig::report
