#include <fmt/format.h>

#include "estimation/road_load/road_load_report.h"
#include "report/blocks.h"
#include "report/fit_pages.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using estimation::RoadLoadFit;
using estimation::RoadLoadPoint;

std::string force_unit(const RoadLoadFit& fit) { return fit.per_mass ? "m/s²" : "N"; }

/// The fitted curve with its interval over the speeds that the data cover.
Json make_load_curve(const RoadLoadFit& fit) {
  constexpr int kPoints = 40;
  constexpr double kWide = 1.96;  // of a normal interval of 95 %
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> low;
  std::vector<double> high;
  for (int i = 0; i <= kPoints; ++i) {
    const double speed_m_s = fit.low_m_s + (fit.high_m_s - fit.low_m_s) * i / kPoints;
    x.push_back(kKmhPerMs * speed_m_s);
    y.push_back(fit.force_N(speed_m_s));
    low.push_back(y.back() - kWide * fit.force_sd_N(speed_m_s));
    high.push_back(y.back() + kWide * fit.force_sd_N(speed_m_s));
  }
  return {{"name", "A + B v + C v² at reference conditions, 95 % band"},
          {"kind", "line"},
          {"x", rounded(x)},
          {"y", rounded(y)},
          {"low", rounded(low)},
          {"high", rounded(high)}};
}

/// Points of one heading; `get` gives what is shown of a point.
template <class Get>
Json make_points(const estimation::CoastdownFile& file, const RoadLoadFit& fit, int heading, Get&& get) {
  const char* name = heading > 0 ? "runs in + heading" : heading < 0 ? "runs in - heading" : "runs";
  Json series = {{"name", name}, {"kind", "points"}, {"x", Json::array()}, {"y", Json::array()}};
  for (const RoadLoadPoint& point : fit.points) {
    if (file.data.runs[point.run].heading != heading) continue;
    series["x"].push_back(rounded(kKmhPerMs * point.speed_m_s));
    series["y"].push_back(rounded(get(point)));
  }
  return series;
}

template <class Get>
void add_headings(const estimation::CoastdownFile& file, const RoadLoadFit& fit, Get&& get, Json& series) {
  for (const int heading : {1, -1, 0}) {
    Json points = make_points(file, fit, heading, get);
    if (!points["x"].empty()) series.push_back(std::move(points));
  }
}

Block make_force_chart(const estimation::CoastdownFile& file, const RoadLoadFit& fit) {
  Json series = Json::array({make_load_curve(fit)});
  add_headings(
      file, fit, [](const RoadLoadPoint& point) { return point.force_N; }, series);
  return make_curves({"Speed", "km/h"}, {fit.per_mass ? "Deceleration" : "Force", force_unit(fit), true}, series,
                     "Points: mean force over a speed bin as tested, with that run's wind, slope and weather.");
}

Block make_road_residual_chart(const estimation::CoastdownFile& file, const RoadLoadFit& fit) {
  Json series = Json::array();
  add_headings(
      file, fit, [](const RoadLoadPoint& point) { return point.residual_N; }, series);
  Block block = make_curves({"Speed", "km/h"}, {"Measured less fitted", force_unit(fit)}, series,
                            "Fit as tested: wind, slope and weather are in it.");
  block["marks"] = {0.0};
  return block;
}

Block make_checks(const estimation::RoadLoadChecks& checks) {
  Table table{"What the standards ask of coastdowns", {"check", "", "found", "limit", "clause"}, {}};
  for (const estimation::RoadLoadCheck& check : checks.checks) {
    table.rows.push_back({check.name, estimation::name_of(check.status), check.found, check.limit, check.clause});
  }
  return make_table(table);
}

}  // namespace

Table make_coefficient_table(const RoadLoadFit& fit, const std::string& title) {
  Table table{title, {"coefficient", "value", "sd", "from", "to", "unit"}, {}};
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto number = [i](double si) { return fmt::format("{:.5g}", estimation::road_load_in_file_unit(i, si)); };
    std::vector<std::string> row{std::string(1, "ABC"[i]), number(fit.values()[at])};
    if (fit.on_bound[at]) {
      row.insert(row.end(), {"on its bound", "", ""});
    } else {
      row.insert(row.end(), {number(fit.sd(i)), number(fit.interval_95(i)[0]), number(fit.interval_95(i)[1])});
    }
    row.push_back(unit_of_key(estimation::road_load_key(i, fit.per_mass)).symbol);
    table.rows.push_back(row);
  }
  return table;
}

Page make_road_load_page(const estimation::CoastdownFile& file, const RoadLoadFitOptions& options,
                         const RoadLoadFit& fit, const estimation::RoadLoadChecks& checks) {
  Page page{"fit road-load", "Road load from coastdowns",
            fmt::format("{}, {}, {}", format_count(file.data.runs.size(), "run"),
                        format_count(fit.points.size(), "speed bin"),
                        file.is_trace ? "from speed traces" : "from times through bins")};
  Section result = begin_section("Coefficients", fit.warnings);
  result.blocks.push_back(make_table(make_coefficient_table(fit, "At reference conditions, with 95 % intervals")));
  page.add(std::move(result));
  page.add({"Data and fit", "", {make_force_chart(file, fit)}});
  page.add({"Residuals", "", {make_road_residual_chart(file, fit)}});
  page.add({"Checks", "", {make_checks(checks)}});
  page.add(make_document(estimation::make_road_load_json(file, options, fit, checks), "The fit as JSON"));
  return page;
}

}  // namespace rollrig::report
