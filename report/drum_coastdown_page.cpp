#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report/blocks.h"
#include "report/fit_pages.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using estimation::CoastSet;
using estimation::DrumCoastdownFit;
using estimation::Interval;
using estimation::PressureLevel;
using estimation::SpeedPoint;

void add_point(const SpeedPoint& at, const Interval& interval, double scale, ChartSeries& points) {
  points.add(kKmhPerMs * at.speed_m_s, scale * interval.value, scale * interval.lower, scale * interval.upper);
}

/// Force where the drum's inertia is known, else the net deceleration in mm/s2.
const Interval& find_net(const PressureLevel& level, bool forces) { return forces ? *level.force_N : level.net_m_s2; }

Block make_net_chart(const CoastSet& set, const DrumCoastdownFit& fit) {
  const bool forces = set.calc_drum_mass_kg().has_value();
  std::set<double> pressures_Pa;
  for (const SpeedPoint& point : fit.points) {
    for (const PressureLevel& level : point.levels) pressures_Pa.insert(level.pressure_Pa);
  }
  Json series = Json::array();
  for (const double pressure_Pa : pressures_Pa) {
    ChartSeries points;
    for (const SpeedPoint& point : fit.points) {
      for (const PressureLevel& level : point.levels) {
        if (level.pressure_Pa != pressure_Pa || (forces && !level.force_N.has_value())) continue;
        add_point(point, find_net(level, forces), forces ? 1.0 : 1e3, points);
      }
    }
    series.push_back(points.finish(fmt::format("{:.0f} kPa", pressure_Pa / 1e3)));
  }
  return make_curves({"Speed", "km/h"}, {forces ? "Rolling resistance" : "Net deceleration", forces ? "N" : "mm/s²"},
                     series, "Net of the drum's own loss, with 95 % intervals.");
}

Block make_exponent_chart(const DrumCoastdownFit& fit) {
  ChartSeries points;
  for (const SpeedPoint& point : fit.points) {
    if (point.pressure_exponent.has_value()) add_point(point, *point.pressure_exponent, 1.0, points);
  }
  return make_curves({"Speed", "km/h"}, {"Exponent of gauge pressure", ""}, Json::array({points.finish("exponent")}),
                     "With 95 % intervals.");
}

std::string show(const std::optional<Interval>& interval, double unit = 1.0, const char* digits = "{:.3f}") {
  if (!interval.has_value()) return "-";
  const auto number = [digits](double value) { return fmt::format(fmt::runtime(digits), value); };
  return fmt::format("{} ({} to {})", number(interval->value / unit), number(interval->lower / unit),
                     number(interval->upper / unit));
}

Table make_overview(const CoastSet& set, const DrumCoastdownFit& fit) {
  std::size_t missed = 0, doubled = 0, other = 0;
  for (const estimation::CoastAnalysis& analysis : fit.analyses) {
    missed += analysis.coast.missed;
    doubled += analysis.coast.doubled;
    other += analysis.coast.other;
  }
  return {"",
          {},
          {{"pulses rejected", fmt::format("{} missed, {} double, {} other", missed, doubled, other)},
           {"reference", fmt::format("{:.1f} kPa, {:.1f} km/h", fit.reference_pressure_Pa / 1e3,
                                     kKmhPerMs * set.reference_speed_m_s)}}};
}

/// Whether runs have different loads.
bool has_loads(const DrumCoastdownFit& fit) {
  double load_N = 0.0;
  for (const SpeedPoint& point : fit.points) {
    for (const PressureLevel& level : point.levels) {
      if (load_N > 0.0 && !estimation::is_same_load(level.load_N, load_N)) return true;
      load_N = level.load_N;
    }
  }
  return false;
}

Table make_level_table(const std::string& title, const DrumCoastdownFit& fit, bool forces) {
  const bool loads = has_loads(fit);
  Table table{title, {"km/h", "kPa", "runs", forces ? "force N" : "net mm/s2", "over the reference"}, {}};
  if (loads) table.columns.insert(table.columns.begin() + 2, "load N");
  for (const SpeedPoint& point : fit.points) {
    for (const PressureLevel& level : point.levels) {
      table.rows.push_back({fmt::format("{:.1f}{}", 3.6 * point.speed_m_s, level.in_range_left_out ? "*" : ""),
                            fmt::format("{:.0f}", level.pressure_Pa / 1e3), fmt::format("{}", level.runs),
                            forces ? show(level.force_N, 1.0, "{:.2f}") : show(level.net_m_s2, 1e-3, "{:.2f}"),
                            show(level.ratio)});
      if (loads) table.rows.back().insert(table.rows.back().begin() + 2, fmt::format("{:.0f}", level.load_N));
    }
  }
  return table;
}

Table make_speed_table(const DrumCoastdownFit& fit) {
  Table table{
      "Drum alone; its standard deviation from run to run", {"km/h", "drum alone mm/s2", "repeatability %"}, {}};
  for (const SpeedPoint& point : fit.points) {
    table.rows.push_back({fmt::format("{:.1f}", 3.6 * point.speed_m_s), show(point.drum_alone_m_s2, 1e-3, "{:.2f}"),
                          show(point.drum_repeatability, 1e-2, "{:.2f}")});
  }
  return table;
}

Table make_law_table(const DrumCoastdownFit& fit) {
  const std::string difference =
      fit.directions.size() == 2 ? fmt::format("{} over {} %", fit.directions[0], fit.directions[1]) : "directions %";
  Table table{
      "Exponent of gauge pressure; difference of directions", {"km/h", "exponent", difference, "sd of one %"}, {}};
  for (const SpeedPoint& point : fit.points) {
    table.rows.push_back({fmt::format("{:.1f}", 3.6 * point.speed_m_s), show(point.pressure_exponent),
                          show(point.direction_ratio, 1e-2, "{:+.2f}"),
                          point.direction_ratio.has_value() ? fmt::format("{:.2f}", 100.0 * point.direction_sd) : "-"});
  }
  return table;
}

/// What the fits leave of the coasts' speeds; of long coasts every so many-th row.
Block make_drum_residual_chart(const CoastSet& set, const DrumCoastdownFit& fit) {
  constexpr std::size_t kMost = 4000;
  std::size_t rows = 0;
  for (const auto& analysis : fit.analyses) {
    for (const auto& at : analysis.decelerations) rows += at.residuals.size();
  }
  const std::size_t stride = 1 + rows / kMost;
  std::map<std::string, ChartSeries> by_state;
  std::size_t row = 0;
  for (const auto& analysis : fit.analyses) {
    const bool is_loaded = set.runs[analysis.run].state == estimation::CoastState::kLoaded;
    ChartSeries& points = by_state[is_loaded ? "tire loaded" : "tire lifted"];
    for (const auto& at : analysis.decelerations) {
      for (const estimation::FittedRow& fitted : at.residuals) {
        if (row++ % stride != 0) continue;
        points.add(kKmhPerMs * fitted.speed_m_s, 1e3 * (fitted.speed_m_s - fitted.fitted_m_s));
      }
    }
  }
  Json series = Json::array();
  for (const auto& [name, points] : by_state) series.push_back(points.finish(name));
  Block block = make_curves({"Speed", "km/h"}, {"Measured minus fitted speed", "mm/s"}, series,
                            stride > 1 ? fmt::format("Every {}th row.", stride) : "Every row.");
  block["marks"] = {0.0};
  return block;
}

}  // namespace

std::vector<Table> make_drum_coastdown_tables(const CoastSet& set, const DrumCoastdownFit& fit) {
  const bool forces = set.calc_drum_mass_kg().has_value();
  std::vector<Table> tables{
      make_overview(set, fit),
      make_level_table("Net of the drum's own loss, with 95 % interval; * interpolated", fit, forces),
      make_speed_table(fit), make_law_table(fit)};
  if (fit.others != nullptr) {
    tables.push_back(make_level_table("The same without the runs in doubt (see the warnings)", *fit.others, forces));
  }
  return tables;
}

namespace {

/// The level at the reference pressure and the speed that is nearest to the reference speed.
std::optional<std::pair<std::size_t, std::size_t>> find_reference_level(const CoastSet& set,
                                                                        const DrumCoastdownFit& fit) {
  const auto away = [&set](const SpeedPoint& point) { return std::abs(point.speed_m_s - set.reference_speed_m_s); };
  const auto nearest = std::min_element(fit.points.begin(), fit.points.end(),
                                        [&](const SpeedPoint& a, const SpeedPoint& b) { return away(a) < away(b); });
  if (nearest == fit.points.end()) return std::nullopt;
  const auto& levels = nearest->levels;
  const auto level = std::find_if(levels.begin(), levels.end(), [&fit](const estimation::PressureLevel& one) {
    return one.pressure_Pa == fit.reference_pressure_Pa;
  });
  if (level == levels.end()) return std::nullopt;
  return std::pair(static_cast<std::size_t>(nearest - fit.points.begin()),
                   static_cast<std::size_t>(level - levels.begin()));
}

std::string show_interval_95(const Interval& interval, double unit, const char* digits) {
  const auto number = [&](double value) { return fmt::format(fmt::runtime(digits), value / unit); };
  return fmt::format("95 % interval {} to {}", number(interval.lower), number(interval.upper));
}

/// Rolling resistance at the reference pressure and speed, or the deceleration where no inertia is known; how it goes
/// with the pressure.
std::vector<Tile> make_coast_tiles(const CoastSet& set, const DrumCoastdownFit& fit) {
  const auto place = find_reference_level(set, fit);
  if (!place.has_value()) return {};
  const SpeedPoint& point = fit.points[place->first];
  const estimation::PressureLevel& level = point.levels[place->second];
  const std::string at =
      fmt::format("at {:.0f} km/h and {:.0f} kPa", kKmhPerMs * point.speed_m_s, 1e-3 * level.pressure_Pa);
  const std::string speed = fmt::format("/speeds/{}", place->first);
  const std::string pressure = fmt::format("{}/pressures/{}", speed, place->second);
  std::vector<Tile> tiles;
  if (level.force_N.has_value()) {
    tiles.push_back({"Rolling resistance",
                     fmt::format("{:.2f}", level.force_N->value),
                     "N",
                     at + "; " + show_interval_95(*level.force_N, 1.0, "{:.2f}"),
                     "",
                     {pressure + "/force_N/value"}});
  } else {
    constexpr double kMm_s2 = 1e-3;
    tiles.push_back({"Deceleration by the tire",
                     fmt::format("{:.2f}", level.net_m_s2.value / kMm_s2),
                     "mm/s2",
                     at + "; " + show_interval_95(level.net_m_s2, kMm_s2, "{:.2f}"),
                     "",
                     {}});
  }
  if (point.pressure_exponent.has_value()) {
    tiles.push_back(
        {"Pressure exponent",
         fmt::format("{:.3f}", point.pressure_exponent->value),
         "",
         fmt::format("rolling resistance goes with pressure to this power, at {:.0f} km/h; {}",
                     kKmhPerMs * point.speed_m_s, show_interval_95(*point.pressure_exponent, 1.0, "{:.3f}")),
         "",
         {speed + "/pressure_exponent/value"}});
  }
  return tiles;
}

}  // namespace

Page make_drum_coastdown_page(const CoastSet& set, const DrumCoastdownFit& fit) {
  Page page{"fit drum-coastdown", fmt::format("Rolling resistance from coast-downs: {}", set.name),
            format_count(set.runs.size(), "run")};
  Section result = make_section("Result", make_drum_coastdown_tables(set, fit), fit.warnings);
  const std::vector<Tile> tiles = make_coast_tiles(set, fit);
  std::vector<Block> first;
  if (!tiles.empty()) {
    const Tile& main = tiles.front();
    first.push_back(make_lead("", fmt::format("{} is {} {} {}.", main.label, main.value, main.unit, main.note)));
    first.push_back(make_tiles(tiles));
  }
  first.push_back(make_net_chart(set, fit));
  put_first(std::move(first), result);
  page.add(std::move(result));
  page.add({"Law of the coasts", "", {make_equations("fit drum_coastdown")}});
  const bool has_exponent = std::any_of(fit.points.begin(), fit.points.end(),
                                        [](const SpeedPoint& point) { return point.pressure_exponent.has_value(); });
  if (has_exponent) page.add({"Pressure", "", {make_exponent_chart(fit)}});
  page.add({"Residuals", "", {make_drum_residual_chart(set, fit)}});
  page.add(make_document(estimation::make_coastdown_json(set, fit), "The fit as JSON"));
  return page;
}

}  // namespace rollrig::report
