#include "report/rolling_law_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/blocks.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using estimation::FittedPoint;
using estimation::ForceEstimate;
using estimation::J2452Fit;
using estimation::J2452Reference;
using estimation::MultipointFit;
using estimation::MultipointReference;
using estimation::ReferenceCondition;
using estimation::RegressionStatistics;
using estimation::RollingPoint;

std::string show_finite(double value, const char* digits) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(digits), value) : "-";
}

Table make_coefficient_rows(const std::vector<ParameterEstimate>& coefficients) {
  Table table{"Coefficients, with standard deviation and 95 % interval", {"", "value", "sd", "from", "to", "unit"}, {}};
  for (const ParameterEstimate& at : coefficients) {
    table.rows.push_back({at.name, show_finite(at.value, "{:.5g}"), show_finite(at.sd, "{:.2g}"),
                          show_finite(at.low_95, "{:.5g}"), show_finite(at.high_95, "{:.5g}"), at.unit});
  }
  return table;
}

Table make_statistics_rows(const RegressionStatistics& statistics) {
  Table list{"Residuals", {}, {}};
  list.rows.push_back({"degrees of freedom", fmt::format("{}", statistics.freedom)});
  if (statistics.freedom > 0) {
    list.rows.push_back({"standard deviation", fmt::format("{:.3g} N", statistics.residual_sd_N)});
  }
  list.rows.push_back({"largest", fmt::format("{:.2g} % of the force", 100.0 * statistics.largest_residual)});
  if (statistics.lack_of_fit.has_value()) {
    const estimation::LackOfFit& lack = *statistics.lack_of_fit;
    list.rows.push_back(
        {"scatter of repeated points",
         fmt::format("{:.3g} N, {}", lack.pure_error_sd_N,
                     format_count(static_cast<std::size_t>(lack.pure_error_freedom), "degree") + " of freedom")});
    list.rows.push_back({"lack of fit", fmt::format("F = {:.3g}, p = {:.2g}", lack.F, lack.p)});
  } else {
    list.rows.push_back({"lack of fit", estimation::explain_no_lack_of_fit(statistics.repeated_points)});
  }
  return list;
}

std::string describe_reference(const ReferenceCondition& at) {
  return fmt::format("{:.0f} N, {:.0f} kPa", at.load_N, at.pressure_Pa / 1e3);
}

std::string show_force(const ForceEstimate& force, int freedom) {
  if (freedom < 1) return fmt::format("{:.2f} N", force.value_N);
  return fmt::format("{:.2f} +- {:.2f} N", force.value_N, estimation::calc_student_reach(freedom) * force.sd_N);
}

/// One load and pressure with its points, by speed.
struct PointGroup {
  double load_N = 0.0;
  double pressure_Pa = 0.0;
  std::vector<FittedPoint> points;

  std::string name() const { return fmt::format("{:.0f} N, {:.0f} kPa", load_N, pressure_Pa / 1e3); }
};

std::vector<PointGroup> group_points(const std::vector<FittedPoint>& points) {
  constexpr double kSame = 0.02;  // as count_levels()
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * std::max(a, b); };
  std::vector<PointGroup> groups;
  for (const FittedPoint& point : points) {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const PointGroup& group) {
      return same(group.load_N, point.point.load_N) && same(group.pressure_Pa, point.point.pressure_Pa);
    });
    PointGroup& group = found == groups.end()
                            ? groups.emplace_back(PointGroup{point.point.load_N, point.point.pressure_Pa, {}})
                            : *found;
    group.points.push_back(point);
  }
  for (PointGroup& group : groups) {
    std::sort(group.points.begin(), group.points.end(),
              [](const FittedPoint& a, const FittedPoint& b) { return a.point.speed_m_s < b.point.speed_m_s; });
  }
  return groups;
}

/// Least and greatest of a member of the points.
std::pair<double, double> find_span(const std::vector<FittedPoint>& points, double RollingPoint::*member) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [member](const FittedPoint& a, const FittedPoint& b) { return a.point.*member < b.point.*member; });
  return {low->point.*member, high->point.*member};
}

constexpr int kCurvePoints = 40;

Block make_speed_chart(const J2452Fit& fit) {
  Json series = Json::array();
  for (const PointGroup& group : group_points(fit.points)) {
    ChartSeries points, curve;
    for (const FittedPoint& at : group.points) points.add(kKmhPerMs * at.point.speed_m_s, at.point.force_N);
    const double low_m_s = group.points.front().point.speed_m_s;
    const double high_m_s = group.points.back().point.speed_m_s;
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double speed_m_s = low_m_s + (high_m_s - low_m_s) * i / kCurvePoints;
      curve.add(kKmhPerMs * speed_m_s, fit.law.calc_force_N(group.pressure_Pa, group.load_N, speed_m_s));
    }
    const std::size_t style = series.size() / 2;  // points and law of a condition alike
    for (Json one : {points.finish(group.name()), curve.finish("law at " + group.name(), "line")}) {
      one["style"] = style;
      series.push_back(std::move(one));
    }
  }
  return make_curves({"Speed", "km/h"}, {"Rolling resistance", "N", true}, series,
                     "Points and the law at one condition have one color. Repeated points may hide each other.");
}

/// The law over load at the least, the middle and the greatest pressure, with its 95 % band.
Block make_load_chart(const J2452Fit& fit) {
  const auto [low_N, high_N] = find_span(fit.points, &RollingPoint::load_N);
  const auto [low_Pa, high_Pa] = find_span(fit.points, &RollingPoint::pressure_Pa);
  const double reach = estimation::calc_student_reach(fit.find_freedom());
  Json series = Json::array();
  for (const double pressure_Pa : {low_Pa, 0.5 * (low_Pa + high_Pa), high_Pa}) {
    ChartSeries curve;
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double load_N = low_N + (high_N - low_N) * i / kCurvePoints;
      const ForceEstimate force = fit.estimate_force({load_N, pressure_Pa, estimation::kReferenceSpeed_m_s});
      curve.add(load_N, force.value_N, force.value_N - reach * force.sd_N, force.value_N + reach * force.sd_N);
    }
    series.push_back(curve.finish(fmt::format("{:.0f} kPa", pressure_Pa / 1e3), "line"));
  }
  return make_curves({"Load", "N"}, {"Rolling resistance at 80 km/h", "N", true}, series,
                     "The fitted law with its 95 % band.");
}

Block make_residual_chart_of(const std::vector<FittedPoint>& points, bool over_speed) {
  Json series = Json::array();
  for (const PointGroup& group : group_points(points)) {
    ChartSeries residuals;
    for (const FittedPoint& at : group.points) {
      residuals.add(over_speed ? kKmhPerMs * at.point.speed_m_s : at.point.load_N, at.residual_N());
    }
    series.push_back(residuals.finish(group.name()));
  }
  Block block =
      make_curves(over_speed ? Axis{"Speed", "km/h"} : Axis{"Load", "N"}, {"Measured minus fitted", "N"}, series);
  block["marks"] = {0.0};
  return block;
}

Block make_multipoint_chart(const MultipointFit& fit) {
  const auto [low_N, high_N] = find_span(fit.points, &RollingPoint::load_N);
  Json series = Json::array();
  ChartSeries points;
  for (const FittedPoint& at : fit.points) points.add(at.point.load_N, at.point.force_N);
  series.push_back(points.finish("points"));
  std::vector<double> pressures_Pa;
  for (const PointGroup& group : group_points(fit.points)) pressures_Pa.push_back(group.pressure_Pa);
  std::sort(pressures_Pa.begin(), pressures_Pa.end());
  for (std::size_t i = 0; i < pressures_Pa.size(); ++i) {
    if (i > 0 && pressures_Pa[i] <= 1.02 * pressures_Pa[i - 1]) continue;
    ChartSeries curve;
    for (int step = 0; step <= kCurvePoints; ++step) {
      const double load_N = low_N + (high_N - low_N) * step / kCurvePoints;
      curve.add(load_N, fit.estimate_force(load_N, pressures_Pa[i]).value_N);
    }
    series.push_back(curve.finish(fmt::format("law at {:.0f} kPa", pressures_Pa[i] / 1e3), "line"));
  }
  return make_curves({"Load", "N"}, {"Rolling resistance", "N", true}, series);
}

std::vector<std::string> collect_warnings(const estimation::RollingTest& test, const std::vector<std::string>& of_fit) {
  std::vector<std::string> warnings = test.warnings;
  warnings.insert(warnings.end(), of_fit.begin(), of_fit.end());
  return warnings;
}

/// Rolling resistance at the standard reference condition, and its coefficient.
std::vector<Tile> make_reference_tiles(const ForceEstimate& force, const estimation::ReferenceCondition& condition,
                                       int freedom) {
  Tile loss{"Rolling resistance",
            fmt::format("{:.2f}", force.value_N),
            "N",
            "at the same condition",
            "",
            {"/reference/rolling_resistance/value_N"}};
  if (freedom > 0) {
    loss.value += fmt::format(" +- {:.2f}", estimation::calc_student_reach(freedom) * force.sd_N);
    loss.note += "; +- is the interval of 95 %";
    loss.from.push_back("/reference/rolling_resistance/half_width_95_N");
  }
  Tile rrc{"RRc at the reference condition",
           fmt::format("{:.3f}", 1e3 * force.value_N / condition.load_N),
           "N/kN",
           fmt::format("at {:.0f} km/h, {}", kKmhPerMs * condition.speed_m_s, describe_reference(condition)),
           "",
           {"/reference/rrc_N_per_kN"}};
  if (freedom > 0) {
    rrc.value +=
        fmt::format(" +- {:.3f}", 1e3 * estimation::calc_student_reach(freedom) * force.sd_N / condition.load_N);
    rrc.note += "; +- is the interval of 95 %";
    rrc.from.push_back("/reference/rrc_half_width_95_N_per_kN");
  }
  return {std::move(rrc), std::move(loss)};
}

/// RRc by the law in the middle of the points, where there is no reference condition.
Tile make_middle_tile(const J2452Fit& fit) {
  const auto count = static_cast<double>(fit.points.size());
  double pressure_Pa = 0.0, load_N = 0.0, speed_m_s = 0.0;
  for (const FittedPoint& at : fit.points) {
    pressure_Pa += at.point.pressure_Pa / count;
    load_N += at.point.load_N / count;
    speed_m_s += at.point.speed_m_s / count;
  }
  return {"RRc in the middle of the points",
          fmt::format("{:.3f}", 1e3 * fit.law.calc_force_N(pressure_Pa, load_N, speed_m_s) / load_N),
          "N/kN",
          fmt::format("by the law at {:.0f} km/h, {:.0f} N and {:.0f} kPa", kKmhPerMs * speed_m_s, load_N,
                      1e-3 * pressure_Pa),
          "",
          {}};
}

/// The tables of the terminal, of which the first has the law in its title and letters by name: the page has the law
/// typeset beside it.
std::vector<Table> typeset_law(std::vector<Table> tables) {
  Table& coefficients = tables.front();
  coefficients.title.erase(coefficients.title.find(':'));
  for (std::vector<std::string>& row : coefficients.rows) {
    if (row.front() == "alpha") row.front() = "α";
    if (row.front() == "beta") row.front() = "β";
  }
  return tables;
}

/// The first tile in a sentence: its value, and in brackets where it is.
Block make_law_lead(const std::vector<Tile>& tiles) {
  const Tile& main = tiles.front();
  std::string where = main.note.substr(0, main.note.find(';'));
  if (where.rfind("at ", 0) == 0) where.erase(0, 3);
  return make_lead("", fmt::format("{} ({}) is {} {} (95 %).", main.label, where, main.value, main.unit));
}

}  // namespace

std::vector<Table> make_j2452_tables(const J2452Fit& fit, const std::optional<J2452Reference>& reference) {
  std::vector<Table> tables{make_coefficient_rows(fit.coefficients)};
  tables.front().title += ": F = P^alpha Z^beta (a + b v + c v^2), in N, kPa, km/h";
  if (reference.has_value()) {
    const int freedom = fit.find_freedom();
    Table list{"Standard reference condition: " + describe_reference(reference->condition), {}, {}};
    list.rows = {
        {"rolling resistance at 80 km/h", show_force(reference->force, freedom)},
        {"RRc at 80 km/h", fmt::format("{:.3f} N/kN", 1e3 * reference->force.value_N / reference->condition.load_N)},
        {"MERF, mean over " + reference->cycles.urban_cycle, show_force(reference->urban, freedom)},
        {"MERF, mean over " + reference->cycles.highway_cycle, show_force(reference->highway, freedom)},
        {"SMERF, 0.55 and 0.45 of these", show_force(reference->combined, freedom)}};
    tables.push_back(list);
  }
  tables.push_back(make_statistics_rows(fit.statistics));
  if (fit.includes_set_scatter()) {
    const estimation::SetScatter& scatter = *fit.set_scatter;
    tables.back().rows.push_back(
        {"scatter from set to set",
         fmt::format("{:.2g} % of the force, {} of freedom (p = {:.2g})", 100.0 * scatter.relative_sd,
                     format_count(static_cast<std::size_t>(fit.find_freedom()), "degree"), scatter.chance)});
  }
  return tables;
}

Page make_j2452_page(const estimation::RollingTest& test, const J2452Fit& fit,
                     const std::optional<J2452Reference>& reference) {
  Page page{"fit j2452", "Rolling resistance by SAE J2452",
            fmt::format("{}{} at {} of load and pressure", test.tire.empty() ? "" : test.tire + ", ",
                        format_count(fit.points.size(), "point"),
                        format_count(group_points(fit.points).size(), "condition"))};
  Section result =
      make_section("Result", typeset_law(make_j2452_tables(fit, reference)), collect_warnings(test, fit.warnings));
  std::vector<Tile> tiles;
  if (reference.has_value()) {
    tiles = make_reference_tiles(reference->force, reference->condition, fit.find_freedom());
    Tile smerf{"Mean equivalent rolling force",
               fmt::format("{:.2f}", reference->combined.value_N),
               "N",
               "SMERF: 0.55 of the urban and 0.45 of the highway cycle",
               "",
               {"/reference/smerf/value_N"}};
    if (const int freedom = fit.find_freedom(); freedom > 0) {
      smerf.value += fmt::format(" +- {:.2f}", estimation::calc_student_reach(freedom) * reference->combined.sd_N);
      smerf.from.push_back("/reference/smerf/half_width_95_N");
    }
    tiles.push_back(std::move(smerf));
  } else {
    tiles.push_back(make_middle_tile(fit));
  }
  tiles.push_back({"Pressure exponent",
                   fmt::format("{:.3f}", fit.law.alpha),
                   "",
                   "α: rolling resistance goes with pressure to this power",
                   "",
                   {"/coefficients/alpha/value"}});
  tiles.push_back({"Load exponent",
                   fmt::format("{:.3f}", fit.law.beta),
                   "",
                   "β: likewise with load",
                   "",
                   {"/coefficients/beta/value"}});
  put_first({make_law_lead(tiles), make_tiles(tiles), make_speed_chart(fit), make_equations("sae_j2452")}, result);
  page.add(std::move(result));
  page.add({"Law over load and pressure", "", {make_load_chart(fit)}});
  page.add({"Residuals", "", {make_residual_chart_of(fit.points, true)}});
  page.add(make_document(estimation::make_j2452_json(test, fit, reference), "The fit as JSON"));
  return page;
}

std::vector<Table> make_multipoint_tables(const MultipointFit& fit,
                                          const std::optional<MultipointReference>& reference) {
  std::vector<Table> tables{make_coefficient_rows(fit.coefficients)};
  tables.front().title += fit.form == estimation::MultipointForm::kBilinear
                              ? ": F = A0 + A1 Z + A2/P + A3 Z/P, in N, kPa"
                              : ": F = Z (A1 + A3/P), in N, kPa";
  Table list;
  list.rows.push_back({"RRc, mean of the points", fmt::format("{:.3f} N/kN", 1e3 * fit.mean_coefficient)});
  if (reference.has_value()) {
    list.title = "Standard reference condition: " + describe_reference(reference->condition);
    list.rows.insert(
        list.rows.begin(),
        {{"rolling resistance", show_force(reference->force, fit.statistics.freedom)},
         {"RRc", fmt::format("{:.3f} N/kN", 1e3 * reference->force.value_N / reference->condition.load_N)}});
  }
  tables.push_back(list);
  tables.push_back(make_statistics_rows(fit.statistics));
  return tables;
}

Page make_multipoint_page(const estimation::RollingTest& test, const MultipointFit& fit,
                          const std::optional<MultipointReference>& reference) {
  Page page{"fit j1269", "Rolling resistance by SAE J1269",
            fmt::format("{}{}, {:.1f} km/h", test.tire.empty() ? "" : test.tire + ", ",
                        format_count(fit.points.size(), "point"), kKmhPerMs * fit.speed_m_s)};
  Section result =
      make_section("Result", typeset_law(make_multipoint_tables(fit, reference)), collect_warnings(test, fit.warnings));
  std::vector<Tile> tiles;
  if (reference.has_value()) {
    tiles = make_reference_tiles(reference->force, reference->condition, fit.statistics.freedom);
  }
  tiles.push_back({"RRc, mean of the points",
                   fmt::format("{:.3f}", 1e3 * fit.mean_coefficient),
                   "N/kN",
                   format_count(fit.points.size(), "point"),
                   "",
                   {"/mean_rrc_N_per_kN"}});
  const char* form =
      fit.form == estimation::MultipointForm::kBilinear ? "fit j1269 bilinear" : "fit j1269 proportional";
  put_first({make_law_lead(tiles), make_tiles(tiles), make_multipoint_chart(fit), make_equations(form)}, result);
  page.add(std::move(result));
  page.add({"Residuals", "", {make_residual_chart_of(fit.points, false)}});
  page.add(make_document(estimation::make_multipoint_json(test, fit, reference), "The fit as JSON"));
  return page;
}

}  // namespace rollrig::report
