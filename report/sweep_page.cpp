#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "comparison/compared.h"
#include "report/blocks.h"
#include "report/list_pages.h"
#include "report/sweep_values.h"
#include "scenarios/run/scenario.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

constexpr const char* kTireAxis = "tire";  // of tires, by name

using Headlines = std::vector<std::pair<std::string, std::string>>;

/// "Whole ISO 28580 test. " where the scenario is known.
std::string name_scenario(const Json& sweep) {
  const scenarios::Scenario* scenario = scenarios::find_scenario_if_any(sweep["scenario"].get<std::string>());
  return scenario != nullptr ? scenario->text.summary.substr(0, scenario->text.summary.find(':')) + ". " : "";
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
  return capitalized(pretty_unit(comparison::label_result(key)));
}

std::string with_unit_of(const std::string& name, const std::string& key) {
  const std::string unit = shown_unit(key);
  return unit.empty() ? name : name + ", " + unit;
}

/// Values of some axes as one name: a line, or a color of bars.
std::string name_sweep_line(const Json& point, const std::vector<std::string>& axes) {
  std::string name;
  for (const std::string& axis : axes) {
    if (!name.empty()) name += ", ";
    const std::string unit = shown_unit(last_part(axis));
    const std::string value = axis_text(point, axis) + (unit.empty() ? "" : " " + unit);
    name += (axis == kTireAxis ? "tire " : name_axis(axis) + " ") + value;
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

/// A line goes from the least value to the greatest, in whatever order they were asked for.
void sort_by_x(Json& line) {
  std::vector<std::pair<Json, Json>> points;
  for (std::size_t i = 0; i < line["x"].size(); ++i) points.emplace_back(line["x"][i], line["y"][i]);
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < points.size(); ++i) {
    line["x"][i] = points[i].first;
    line["y"][i] = points[i].second;
  }
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
    if (!has_lines && others.empty()) own["labels"].push_back(fmt::format("{:.4g}", result_value(point, key)));
    if (std::find(categories.begin(), categories.end(), at) == categories.end()) categories.push_back(at);
  }
  if (has_lines) std::for_each(series.begin(), series.end(), sort_by_x);
  const Axis y{name, shown_unit(key)};
  if (!has_lines) return make_bars(y, categories, series);
  return make_curves({capitalized(name_axis(drawn)), shown_unit(last_part(drawn))}, y, series);
}

/// Value of a result at a point, with its unit.
std::string show_result(double value, const std::string& key) {
  const std::string unit = shown_unit(key);
  return fmt::format("{:.4g}{}", value, unit.empty() ? "" : " " + unit);
}

/// Conditions of the test that differ from tire to tire, as its own load does: "load: a40 5570 N, a50 6865 N"; empty
/// where nothing differs, or where tires are not what is varied.
std::string describe_other_conditions(const Json& sweep, const std::vector<std::string>& axes) {
  constexpr const char* kConditions[] = {"load_N", "speed_km_h", "pressure_set_kPa"};
  if (std::find(axes.begin(), axes.end(), kTireAxis) == axes.end()) return "";
  const auto is_other = [](double a, double b) { return std::abs(a - b) > 1e-3 * std::abs(b); };
  std::vector<std::string> texts;
  for (const char* key : kConditions) {
    const std::vector<double> values = list_results(sweep, key);
    std::vector<std::pair<std::string, double>> of_tires;
    bool differs = false;
    bool is_varied = false;  // the tire alone does not say it
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string tire = axis_text(sweep["points"][i], kTireAxis);
      const auto known =
          std::find_if(of_tires.begin(), of_tires.end(), [&tire](const auto& one) { return one.first == tire; });
      if (known != of_tires.end()) {
        is_varied = is_varied || is_other(values[i], known->second);
      } else {
        of_tires.emplace_back(tire, values[i]);
      }
      differs = differs || is_other(values[i], of_tires.front().second);
    }
    if (!differs || is_varied) continue;
    std::vector<std::string> each;
    for (const auto& [tire, value] : of_tires) each.push_back(tire + " " + show_result(value, key));
    texts.push_back(fmt::format("{}: {}", name_axis(key), fmt::join(each, ", ")));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
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

/// The tile of a sensitivity; where the curve bends, the range of its slopes.
Tile make_sensitivity_tile(const Json& sensitivity, const std::string& place) {
  Tile tile{"Sensitivity to " + name_axis(sensitivity["varied"]),
            fmt::format("{:+.2f}", sensitivity["percent"].get<double>()),
            fmt::format("% per {}", sensitivity["per"].get<std::string>()),
            "straight line through all runs, of the mean",
            "",
            {place + "/percent"}};
  if (sensitivity.value("is_straight", true)) return tile;
  tile.value = fmt::format("{:+.2f} to {:+.2f}", sensitivity["lowest_percent"].get<double>(),
                           sensitivity["highest_percent"].get<double>());
  tile.note = "not straight: from one value to the next, of the mean";
  tile.from = {place + "/lowest_percent", place + "/highest_percent"};
  return tile;
}

/// A result at a point.
Tile make_point_tile(const Json& sweep, std::size_t point, const std::string& key, const std::string& name) {
  const std::size_t points = sweep["points"].size();
  Tile tile{name,
            fmt::format("{:.4g}", list_results(sweep, key)[point]),
            unit_of_key(key).symbol,
            points == 1 ? name_sweep_line(sweep["points"][point], list_sweep_axes(sweep))
                        : fmt::format("the same in all {} runs", points),
            "",
            {}};
  // A number of a list has another place in the file.
  if (key.find('.') == std::string::npos) tile.from = {fmt::format("/points/{}/result/{}", point, key)};
  return tile;
}

/// "RRc at 25 °C, 2 m drum is 5.204 N/kN at pressure 250 kPa."
std::string describe_tile(const Tile& tile) {
  const std::string unit = tile.unit.empty() ? "" : " " + tile.unit;
  const char* before = tile.note.rfind("the same", 0) == 0 ? "," : " at";
  return fmt::format("{} is {}{}{} {}.", pretty_unit(tile.label), tile.value, unit, before, tile.note);
}

/// What matters most, where nothing changes from point to point, as with a single one.
std::vector<Tile> make_equal_tiles(const Json& sweep, const Headlines& headlines) {
  constexpr std::size_t kMost = 4;
  const std::vector<std::string> known = list_numbers(sweep);
  std::vector<std::string> keys;
  for (const auto& headline : headlines) {
    if (std::find(known.begin(), known.end(), headline.first) != known.end()) keys.push_back(headline.first);
  }
  if (keys.empty() && !known.empty()) keys.push_back(known.front());
  std::vector<Tile> tiles;
  for (const std::string& key : keys) {
    const std::vector<double> values = list_results(sweep, key);
    const auto first = std::find_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
    if (first == values.end() || tiles.size() == kMost) continue;
    const auto point = static_cast<std::size_t>(first - values.begin());
    tiles.push_back(make_point_tile(sweep, point, key, name_result(key, headlines)));
  }
  return tiles;
}

/// The places of the least and the largest value; the number of values where none is a number.
std::pair<std::size_t, std::size_t> find_extremes(const std::vector<double>& values) {
  std::size_t lowest = values.size(), highest = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (lowest == values.size() || values[i] < values[lowest]) lowest = i;
    if (highest == values.size() || values[i] > values[highest]) highest = i;
  }
  return {lowest, highest};
}

/// The first result's range, and its sensitivity to each axis.
std::vector<Tile> make_sweep_tiles(const Json& sweep, const std::string& key, const std::string& name) {
  const std::vector<double> values = list_results(sweep, key);
  const auto [lowest, highest] = find_extremes(values);
  if (lowest == values.size()) return {};
  if (!(values[lowest] < values[highest])) return {make_point_tile(sweep, lowest, key, name)};
  std::vector<Tile> tiles;
  const auto add_end = [&](const char* which, std::size_t point) {
    tiles.push_back(make_point_tile(sweep, point, key, fmt::format("{} {}", which, name)));
    tiles.back().note = name_sweep_line(sweep["points"][point], list_sweep_axes(sweep));
  };
  add_end("Lowest", lowest);
  add_end("Highest", highest);
  for (std::size_t i = 0; i < sweep["sensitivities"].size(); ++i) {
    const Json& sensitivity = sweep["sensitivities"][i];
    if (sensitivity["result"] == key) {
      tiles.push_back(make_sensitivity_tile(sensitivity, fmt::format("/sensitivities/{}", i)));
    }
  }
  return tiles;
}

/// What the sweep found of a result, in a sentence.
std::string describe_sweep(const Json& sweep, const std::vector<std::string>& axes, const std::string& key,
                           const std::string& name) {
  const std::vector<double> values = list_results(sweep, key);
  const auto [lowest, highest] = find_extremes(values);
  if (lowest == values.size()) return "";
  const auto place = [&](std::size_t i) { return name_sweep_line(sweep["points"][i], axes); };
  if (!(values[lowest] < values[highest])) {
    return fmt::format("{} is {} {}.", name, show_result(values[lowest], key),
                       values.size() == 1 ? "at " + place(lowest) : fmt::format("in all {} runs", values.size()));
  }
  std::vector<std::string> slopes;
  bool falls = false;
  for (const Json& sensitivity : sweep["sensitivities"]) {
    if (sensitivity["result"] != key || !sensitivity.value("is_straight", true)) continue;
    falls = sensitivity["percent"].get<double>() < 0.0;
    slopes.push_back(fmt::format("{:+.2f} % per {} of {}", sensitivity["percent"].get<double>(),
                                 sensitivity["per"].get<std::string>(), name_axis(sensitivity["varied"])));
  }
  const std::string changes = slopes.empty() ? "" : fmt::format(": {}", fmt::join(slopes, " and "));
  if (axes.size() == 1 && is_numeric_axis(sweep, axes.front())) {
    const char* const moves = slopes.empty() ? "goes" : falls ? "falls" : "rises";
    const auto [from, to] = falls ? std::pair(highest, lowest) : std::pair(lowest, highest);
    return fmt::format("{} {} from {} at {} to {} at {}{}.", name, moves, show_result(values[from], key), place(from),
                       show_result(values[to], key), place(to), changes);
  }
  return fmt::format("{} is lowest with {}, {}, and highest with {}, {}{}.", name, place(lowest),
                     show_result(values[lowest], key), place(highest), show_result(values[highest], key), changes);
}

/// Why a result that is corrected to 25 °C changes with the ambient temperature that it is corrected for.
std::string explain_ambient(const std::vector<std::string>& axes, const std::string& key) {
  const bool has_ambient =
      std::any_of(axes.begin(), axes.end(), [](const std::string& axis) { return last_part(axis) == "ambient_degC"; });
  if (!has_ambient || last_part(key).find("25degC") == std::string::npos) return "";
  return "The value at 25 °C still depends on the ambient temperature: it is corrected with the "
         "coefficient of the standard or of the tire file, not by what this tire does.";
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
  const std::vector<std::string> axes = list_sweep_axes(sweep);
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
  if (shown.empty()) shown = choose_drawn_results(sweep);
  const std::vector<std::string> axes = list_sweep_axes(sweep);
  std::vector<std::string> names;
  for (const std::string& axis : axes) names.push_back(name_axis(axis));
  Page page{"sweep", fmt::format("Sweep over {}", fmt::join(names, " and ")), name_scenario(sweep) + subtitle};
  Section charts{"Results"};
  const std::vector<Tile> tiles = shown.empty()
                                      ? make_equal_tiles(sweep, headlines)
                                      : make_sweep_tiles(sweep, shown.front(), name_result(shown.front(), headlines));
  if (!shown.empty()) {
    const std::string others = describe_other_conditions(sweep, axes);
    const std::string text = describe_sweep(sweep, axes, shown.front(), name_result(shown.front(), headlines));
    if (!text.empty()) {
      std::string more = others.empty() ? "" : "The tests differ in their " + others + ".";
      const std::string why = explain_ambient(axes, shown.front());
      if (!why.empty()) more += (more.empty() ? "" : " ") + why;
      charts.blocks.push_back(make_lead("", text, more));
    }
  } else if (!tiles.empty()) {
    charts.blocks.push_back(make_lead("", describe_tile(tiles.front())));
  }
  if (!tiles.empty()) charts.blocks.push_back(make_tiles(tiles));
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
