#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "report/blocks.h"
#include "report/list_pages.h"
#include "scenarios/run/scenario.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

constexpr const char* kTireAxis = "tire";  // of tires, by name

using Headlines = std::vector<std::pair<std::string, std::string>>;

/// Settings that are varied, in their order.
std::vector<std::string> list_axes(const Json& sweep) {
  std::vector<std::string> axes;
  for (const auto& [key, value] : sweep["points"].front()["set"].items()) axes.push_back(key);
  return axes;
}

bool is_numeric_axis(const Json& sweep, const std::string& axis) {
  return std::all_of(sweep["points"].begin(), sweep["points"].end(), [&axis](const Json& point) {
    return parse_number(point["set"][axis].get<std::string>()).has_value();
  });
}

Headlines find_headlines(const Json& sweep) {
  const scenarios::Scenario* scenario = scenarios::find_scenario_if_any(sweep["scenario"].get<std::string>());
  return scenario != nullptr ? scenario->headlines : Headlines{};
}

/// Name of a key as a person reads it: "RRc at 25 degC, 2 m drum" where it is declared, else "Liner temperature".
std::string name_result(const std::string& key, const Headlines& headlines) {
  for (const auto& [known, label] : headlines) {
    if (known == key) return pretty_unit(label);
  }
  std::string name = plain_name(key);
  if (name.rfind("rrc", 0) == 0) name.replace(0, 3, "RRc");
  return capitalized(boost::algorithm::replace_all_copy(name, "degC", " °C"));
}

std::string name_axis(const std::string& axis) { return plain_name(last_part(axis)); }

std::string with_unit_of(const std::string& name, const std::string& key) {
  const std::string unit = shown_unit(key);
  return unit.empty() ? name : name + ", " + unit;
}

std::string axis_text(const Json& point, const std::string& axis) { return point["set"][axis].get<std::string>(); }

double axis_value(const Json& point, const std::string& axis) { return *parse_number(axis_text(point, axis)); }

double result_value(const Json& point, const std::string& key) {
  const Json value = point["result"].value(key, Json());
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> list_results(const Json& sweep, const std::string& key) {
  std::vector<double> values;
  for (const Json& point : sweep["points"]) values.push_back(result_value(point, key));
  return values;
}

/// Whether two results are the same but for a factor: their charts would be the same, too.
bool are_proportional(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSame = 1e-6;  // relative: what six digits show
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] * b.front() - b[i] * a.front()) <= kSame * std::abs(a[i] * b.front()))) return false;
  }
  return true;
}

/// What has a chart where none is named: nothing twice, not what is varied itself.
std::vector<std::string> drop_doubles(const Json& sweep) {
  std::vector<std::vector<double>> seen;
  for (const std::string& axis : list_axes(sweep)) {
    if (!is_numeric_axis(sweep, axis)) continue;
    seen.emplace_back();
    for (const Json& point : sweep["points"]) seen.back().push_back(axis_value(point, axis));
  }
  std::vector<std::string> chosen;
  for (const std::string& key : choose_charts(sweep)) {
    const std::vector<double> values = list_results(sweep, key);
    const bool is_known =
        std::any_of(seen.begin(), seen.end(), [&values](const auto& one) { return are_proportional(values, one); });
    if (is_known) continue;
    chosen.push_back(key);
    seen.push_back(values);
  }
  return chosen;
}

/// Values of some axes as one name: a line, or a color of bars.
std::string name_sweep_line(const Json& point, const std::vector<std::string>& axes) {
  std::string name;
  for (const std::string& axis : axes) {
    if (!name.empty()) name += ", ";
    const std::string unit = shown_unit(last_part(axis));
    const std::string value = axis_text(point, axis) + (unit.empty() ? "" : " " + unit);
    name += axis == kTireAxis ? value : name_axis(axis) + " " + value;
  }
  return name;
}

/// The axis along which results are drawn: the first of numbers, else the first.
std::string choose_drawn_axis(const Json& sweep, const std::vector<std::string>& axes) {
  const auto numeric = std::find_if(axes.begin(), axes.end(),
                                    [&sweep](const std::string& axis) { return is_numeric_axis(sweep, axis); });
  return numeric != axes.end() ? *numeric : axes.front();
}

/// Whether there is a chart: an axis of words other than tires has no order.
bool has_chart(const Json& sweep, const std::vector<std::string>& axes) {
  const std::string drawn = choose_drawn_axis(sweep, axes);
  return sweep["points"].size() > 1 && (drawn == kTireAxis || is_numeric_axis(sweep, drawn));
}

/// The series of a name, which is made where it is not there yet.
Json& find_sweep_series(Json& series, const std::string& name, const Json& empty) {
  for (Json& each : series) {
    if (each["name"] == name) return each;
  }
  series.push_back(empty);
  series.back()["name"] = name;
  return series.back();
}

/// Lines over a quantity, or bars over tires; a line or a color for each of the values of the others.
Block make_sweep_curves(const Json& sweep, const std::vector<std::string>& axes, const std::string& key,
                        const std::string& name) {
  const std::string drawn = choose_drawn_axis(sweep, axes);
  std::vector<std::string> others = axes;
  others.erase(std::find(others.begin(), others.end(), drawn));
  const bool has_lines = is_numeric_axis(sweep, drawn);
  const Json empty = has_lines ? Json{{"name", ""}, {"kind", "line"}, {"x", Json::array()}, {"y", Json::array()}}
                               : Json{{"name", ""}, {"values", Json::array()}};
  Json series = Json::array();
  Json categories = Json::array();
  for (const Json& point : sweep["points"]) {
    Json& own = find_sweep_series(series, others.empty() ? name : name_sweep_line(point, others), empty);
    const std::string at = axis_text(point, drawn);
    if (has_lines) own["x"].push_back(axis_value(point, drawn));
    own[has_lines ? "y" : "values"].push_back(rounded(result_value(point, key)));
    if (std::find(categories.begin(), categories.end(), at) == categories.end()) categories.push_back(at);
  }
  const Axis y{name, shown_unit(key)};
  if (!has_lines) return make_bars(y, categories, series);
  return make_curves({capitalized(name_axis(drawn)), shown_unit(last_part(drawn))}, y, series);
}

/// A result over two variables as shades, with its numbers.
Block make_heat_map(const Json& sweep, const std::vector<std::string>& axes, const std::string& key,
                    const std::string& name) {
  constexpr double kShade = 4.0;  // of the value that is furthest from the middle
  std::vector<std::string> columns, rows;
  const auto add_once = [](std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Json& point : sweep["points"]) {
    add_once(columns, axis_text(point, axes[0]));
    add_once(rows, axis_text(point, axes[1]));
    const double value = result_value(point, key);
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  Json map = Json::array();
  for (const std::string& row : rows) {
    Json cells = Json::array();
    for (const std::string& column : columns) {
      const auto at = std::find_if(sweep["points"].begin(), sweep["points"].end(), [&](const Json& point) {
        return axis_text(point, axes[0]) == column && axis_text(point, axes[1]) == row;
      });
      const double value = at != sweep["points"].end() ? result_value(*at, key) : std::nan("");
      cells.push_back(std::isnan(value)
                          ? Json()
                          : Json{{"text", fmt::format("{:#.4g}", value)},
                                 {"shade", half > 0.0 ? std::lround(kShade * (value - middle) / half) : 0}});
    }
    map.push_back({{"group", ""}, {"label", row}, {"cells", cells}});
  }
  return {
      {"type", "map"},
      {"caption", fmt::format("{} over {} and {}", with_unit_of(name, key), name_axis(axes[0]), name_axis(axes[1]))},
      {"heads", {"", with_unit_of(name_axis(axes[1]), last_part(axes[1]))}},
      {"columns", columns},
      {"rows", map},
      {"legend", fmt::format("Columns: {}. Orange: above the middle of the range, blue: below.",
                             with_unit_of(name_axis(axes[0]), last_part(axes[0])))}};
}

/// The step of an axis in which its sensitivity reads well: 10 kPa, 1 K, 10 km/h, 1 kN.
struct SensitivityStep {
  double size = 1.0;  // in the axis's unit
  std::string text;
};

SensitivityStep find_step(const std::string& axis) {
  const std::string unit = shown_unit(last_part(axis));
  if (unit == "kPa") return {10.0, "10 kPa"};
  if (unit == "°C") return {1.0, "K"};
  if (unit == "km/h") return {10.0, "10 km/h"};
  if (unit == "N") return {1000.0, "kN"};
  return {1.0, unit.empty() ? "unit of " + name_axis(axis) : unit};
}

/// Slope of a result over an axis in percent of its mean a step, by least squares over all points; the other axes are
/// run through alike at each of its values, so that they do not matter.
std::optional<double> calc_sensitivity_percent(const Json& sweep, const std::string& axis, const std::string& key) {
  double count = 0.0, mean_x = 0.0, mean_y = 0.0;
  for (const Json& point : sweep["points"]) {
    const double y = result_value(point, key);
    if (std::isnan(y)) return std::nullopt;  // the grid has a hole
    ++count;
    mean_x += axis_value(point, axis);
    mean_y += y;
  }
  mean_x /= count;
  mean_y /= count;
  double xx = 0.0, xy = 0.0;
  for (const Json& point : sweep["points"]) {
    const double x = axis_value(point, axis) - mean_x;
    xx += x * x;
    xy += x * (result_value(point, key) - mean_y);
  }
  if (!(xx > 0.0) || mean_y == 0.0) return std::nullopt;
  return 100.0 * find_step(axis).size * xy / xx / mean_y;
}

/// Slopes from each value of an axis to the next, of the means over the other axes, likewise in percent a step; empty
/// where the axis has two values.
std::vector<double> list_local_percents(const Json& sweep, const std::string& axis, const std::string& key) {
  std::map<double, std::pair<double, double>> sums;  // count and sum of the result by the axis's value
  double mean = 0.0;
  for (const Json& point : sweep["points"]) {
    auto& [count, sum] = sums[axis_value(point, axis)];
    ++count;
    sum += result_value(point, key);
    mean += result_value(point, key) / static_cast<double>(sweep["points"].size());
  }
  std::vector<double> percents;
  if (sums.size() < 3) return percents;
  for (auto at = sums.begin(); std::next(at) != sums.end(); ++at) {
    const auto& [x, from] = *at;
    const auto& [next_x, to] = *std::next(at);
    percents.push_back(100.0 * find_step(axis).size * (to.second / to.first - from.second / from.first) / (next_x - x) /
                       mean);
  }
  return percents;
}

/// The tile of a sensitivity; where the curve bends, the range of its slopes.
Tile make_sensitivity_tile(const Json& sweep, const std::string& axis, const std::string& key, double percent) {
  constexpr double kStraight = 0.5;  // Assumed: of the mean slope, by which a slope may differ from another
  Tile tile{"Sensitivity to " + name_axis(axis),
            fmt::format("{:+.2f}", percent),
            "% per " + find_step(axis).text,
            "straight line through all runs, of the mean",
            "",
            {}};
  const std::vector<double> locals = list_local_percents(sweep, axis, key);
  if (locals.empty()) return tile;
  const auto [low, high] = std::minmax_element(locals.begin(), locals.end());
  if (*high - *low <= kStraight * std::abs(percent)) return tile;
  tile.value = fmt::format("{:+.2f} to {:+.2f}", *low, *high);
  tile.note = "not straight: from one value to the next, of the mean";
  return tile;
}

/// The first result's range, and its sensitivity to each axis.
std::vector<Tile> make_sweep_tiles(const Json& sweep, const std::vector<std::string>& axes, const std::string& key,
                                   const std::string& name) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : list_results(sweep, key)) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(high >= low)) return {};
  std::vector<Tile> tiles{{name,
                           fmt::format("{:.4g} to {:.4g}", low, high),
                           unit_of_key(key).symbol,
                           "over " + format_count(sweep["points"].size(), "run"),
                           "",
                           {}}};
  for (const std::string& axis : axes) {
    if (!is_numeric_axis(sweep, axis)) continue;
    const std::optional<double> percent = calc_sensitivity_percent(sweep, axis, key);
    if (!percent.has_value()) continue;
    tiles.push_back(make_sensitivity_tile(sweep, axis, key, *percent));
  }
  return tiles;
}

std::vector<std::string> list_point_failures(const Json& sweep) {
  std::vector<std::string> failures;
  for (const Json& point : sweep["points"]) {
    if (!point.contains("failure")) continue;
    std::string name = "failed";
    for (const auto& [axis, value] : point["set"].items()) {
      name += fmt::format(", {} {}", axis, value.get<std::string>());
    }
    failures.push_back(fmt::format("{}: {}", name, point["failure"].get<std::string>()));
  }
  return failures;
}

Section make_runs_of_sweep(const Json& sweep, const std::vector<std::string>& shown, const Headlines& headlines) {
  std::vector<std::string> keys = list_numbers(sweep);
  const std::size_t all = keys.size();
  const auto is_shown = [&shown](const std::string& key) {
    return key.find('.') == std::string::npos || std::find(shown.begin(), shown.end(), key) != shown.end();
  };
  keys.erase(std::remove_if(keys.begin(), keys.end(), [&](const std::string& key) { return !is_shown(key); }),
             keys.end());
  std::stable_partition(keys.begin(), keys.end(), [&shown](const std::string& key) {
    return std::find(shown.begin(), shown.end(), key) != shown.end();
  });
  Table table = make_sweep_table(sweep, "All " + format_count(sweep["points"].size(), "run"), keys);
  const std::vector<std::string> axes = list_axes(sweep);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string key = table.columns[i];
    const bool is_axis = i < axes.size();
    table.columns[i] =
        with_unit_of(is_axis ? capitalized(name_axis(key)) : name_result(key, headlines), last_part(key));
  }
  Section runs{"All runs", "", {make_table(table)}};
  if (keys.size() < all) {
    runs.blocks.push_back(make_paragraph(fmt::format(
        "{} of {} results are on this page. --show names others; sweep.csv of --out has all.", keys.size(), all)));
  }
  return runs;
}

}  // namespace

Page make_sweep_page(const Json& sweep, std::vector<std::string> shown, const std::string& subtitle) {
  const Headlines headlines = find_headlines(sweep);
  if (shown.empty()) shown = drop_doubles(sweep);
  const std::vector<std::string> axes = list_axes(sweep);
  std::vector<std::string> names;
  for (const std::string& axis : axes) names.push_back(name_axis(axis));
  Page page{"sweep",
            fmt::format("Sweep of {} over {}", sweep["scenario"].get<std::string>(), fmt::join(names, " and ")),
            subtitle};
  Section charts{"Results"};
  if (!shown.empty()) {
    const std::vector<Tile> tiles = make_sweep_tiles(sweep, axes, shown.front(), name_result(shown.front(), headlines));
    if (!tiles.empty()) charts.blocks.push_back(make_tiles(tiles));
  }
  const std::vector<std::string> failures = list_point_failures(sweep);
  if (!failures.empty()) charts.blocks.push_back(make_warnings(failures));
  if (!shown.empty() && axes.size() == 2) {
    charts.blocks.push_back(make_heat_map(sweep, axes, shown.front(), name_result(shown.front(), headlines)));
  }
  for (const std::string& key : has_chart(sweep, axes) ? shown : std::vector<std::string>{}) {
    charts.blocks.push_back(make_sweep_curves(sweep, axes, key, name_result(key, headlines)));
  }
  page.add(std::move(charts));
  page.add(make_runs_of_sweep(sweep, shown, headlines));
  return page;
}

}  // namespace rollrig::report
