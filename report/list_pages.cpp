#include "report/list_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/blocks.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

constexpr const char* kTireAxis = "tire";  // of tires, by name

/// Settings that are varied, in their order.
std::vector<std::string> find_axes(const Json& sweep) {
  std::vector<std::string> axes;
  for (const auto& [key, value] : sweep["points"].front()["set"].items()) axes.push_back(key);
  return axes;
}

bool is_numeric(const Json& sweep, const std::string& axis) {
  return std::all_of(sweep["points"].begin(), sweep["points"].end(), [&axis](const Json& point) {
    return parse_number(point["set"][axis].get<std::string>()).has_value();
  });
}

/// Values of some axes as one name: a line, or a color of bars.
std::string name_line(const Json& point, const std::vector<std::string>& axes) {
  std::string name;
  for (const std::string& axis : axes) {
    const std::string value = point["set"][axis];
    if (!name.empty()) name += ", ";
    name += axis == kTireAxis ? value : fmt::format("{} {}", axis, value);
  }
  return name;
}

/// The axis along which results are drawn: the first of numbers, else the first.
std::string choose_drawn_axis(const Json& sweep, const std::vector<std::string>& axes) {
  const auto numeric =
      std::find_if(axes.begin(), axes.end(), [&sweep](const std::string& axis) { return is_numeric(sweep, axis); });
  return numeric != axes.end() ? *numeric : axes.front();
}

/// The series of a name, which is made where it is not there yet.
Json& find_series(Json& series, const std::string& name, const Json& empty) {
  for (Json& each : series) {
    if (each["name"] == name) return each;
  }
  series.push_back(empty);
  series.back()["name"] = name;
  return series.back();
}

Json read_result(const Json& point, const std::string& result) {
  const Json value = point["result"].value(result, Json(nullptr));
  return value.is_number() ? rounded(value.get<double>()) : Json(nullptr);
}

/// Lines over a quantity, or bars over tires and other words; a line or a color for each of the values of the others.
Block make_sweep_chart(const Json& sweep, const std::vector<std::string>& axes, const std::string& result) {
  const std::string drawn = choose_drawn_axis(sweep, axes);
  std::vector<std::string> others = axes;
  others.erase(std::find(others.begin(), others.end(), drawn));
  const bool has_lines = is_numeric(sweep, drawn);
  const Json empty = has_lines ? Json{{"name", ""}, {"kind", "line"}, {"x", Json::array()}, {"y", Json::array()}}
                               : Json{{"name", ""}, {"values", Json::array()}};
  Json series = Json::array();
  Json categories = Json::array();
  for (const Json& point : sweep["points"]) {
    Json& own = find_series(series, others.empty() ? plain_name(result) : name_line(point, others), empty);
    const Json at = point["set"][drawn];
    if (has_lines) own["x"].push_back(*parse_number(at.get<std::string>()));
    own[has_lines ? "y" : "values"].push_back(read_result(point, result));
    if (std::find(categories.begin(), categories.end(), at) == categories.end()) categories.push_back(at);
  }
  const Axis y{plain_name(result), shown_unit(result)};
  if (!has_lines) return make_bars(y, categories, series);
  const std::string axis = last_part(drawn);
  return make_curves({plain_name(axis), shown_unit(axis)}, y, series);
}

/// Not of a list.
bool is_alone(const std::string& key) { return key.find('.') == std::string::npos; }

/// Whether there is a chart: of other words than tires, what is alike is not known.
bool is_shown(const Json& sweep, const std::vector<std::string>& axes) {
  const std::string drawn = choose_drawn_axis(sweep, axes);
  return drawn == kTireAxis || is_numeric(sweep, drawn);
}

/// A result at every point, null where a point has none.
std::vector<Json> list_values(const Json& sweep, const std::string& key) {
  std::vector<Json> values;
  for (const Json& point : sweep["points"]) values.push_back(point["result"].value(key, Json()));
  return values;
}

}  // namespace

std::vector<std::string> list_numbers(const Json& sweep) {
  std::vector<std::string> keys;
  for (const Json& point : sweep["points"]) {
    auto next = keys.begin();
    for (const auto& [key, value] : point["result"].items()) {
      const auto known = std::find(keys.begin(), keys.end(), key);
      next = known != keys.end() ? known + 1 : keys.insert(next, key) + 1;
    }
  }
  return keys;
}

std::vector<std::string> choose_charts(const Json& sweep) {
  constexpr std::size_t kMostOfLists = 12;
  std::vector<std::string> alone;
  std::vector<std::string> of_lists;
  for (const std::string& key : list_changing(sweep)) (is_alone(key) ? alone : of_lists).push_back(key);
  if (!alone.empty()) return alone;
  of_lists.resize(std::min(of_lists.size(), kMostOfLists));
  return of_lists;
}

std::vector<std::string> list_changing(const Json& sweep) {
  constexpr double kSame = 1e-6;  // relative
  std::vector<std::string> keys;
  for (const std::string& key : list_numbers(sweep)) {
    if (unit_of_key(key).symbol == "s") continue;
    const std::vector<Json> values = list_values(sweep, key);
    const bool changes = std::any_of(values.begin(), values.end(), [&values](const Json& value) {
      if (!value.is_number() || !values.front().is_number()) return value.is_number() != values.front().is_number();
      const double first = values.front();
      return std::abs(value.get<double>() - first) > kSame * std::abs(first);
    });
    if (changes) keys.push_back(key);
  }
  return keys;
}

Table make_sweep_table(const Json& sweep, const std::string& title, const std::vector<std::string>& keys) {
  Table table{title, find_axes(sweep), {}};
  table.columns.insert(table.columns.end(), keys.begin(), keys.end());
  for (const Json& point : sweep["points"]) {
    std::vector<std::string> row;
    for (const auto& [axis, value] : point["set"].items()) row.push_back(value.get<std::string>());
    for (const std::string& key : keys) {
      const Json value = point["result"].value(key, Json());
      row.push_back(value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

Page make_sweep_page(const Json& sweep, std::vector<std::string> shown, const std::string& subtitle) {
  if (shown.empty()) shown = choose_charts(sweep);
  const std::vector<std::string> axes = find_axes(sweep);
  const std::string scenario = sweep["scenario"];
  Page page{"sweep", fmt::format("Sweep of {} over {}", scenario, fmt::join(axes, ", ")), subtitle};
  Section charts{"Results"};
  std::vector<std::string> failures;
  for (const Json& point : sweep["points"]) {
    if (!point.contains("failure")) continue;
    std::string name = "failed";
    for (const auto& [axis, value] : point["set"].items())
      name += fmt::format(", {} {}", axis, value.get<std::string>());
    failures.push_back(fmt::format("{}: {}", name, point["failure"].get<std::string>()));
  }
  if (!failures.empty()) charts.blocks.push_back(make_warnings(failures));
  if (is_shown(sweep, axes) && sweep["points"].size() > 1) {
    for (const std::string& result : shown) charts.blocks.push_back(make_sweep_chart(sweep, axes, result));
  }
  page.add(std::move(charts));
  std::vector<std::string> keys = list_numbers(sweep);
  const std::size_t all = keys.size();
  keys.erase(std::remove_if(keys.begin(), keys.end(),
                            [&shown](const std::string& key) {
                              return !is_alone(key) && std::find(shown.begin(), shown.end(), key) == shown.end();
                            }),
             keys.end());
  const std::string title = "All " + format_count(sweep["points"].size(), "run");
  Section runs{"All runs", "", {make_table(make_sweep_table(sweep, title, keys))}};
  if (keys.size() < all) {
    runs.blocks.push_back(make_paragraph(fmt::format(
        "{} of {} results are on this page. --show names others; sweep.csv of --out has all.", keys.size(), all)));
  }
  page.add(std::move(runs));
  return page;
}

namespace {

/// Of a tolerance; beyond all where that is 0.
std::string show_share(const Json& share) {
  return share.is_null() ? "none allowed" : fmt::format("{:.2g}", share.get<double>());
}

}  // namespace

Table make_regress_table(const Json& regression) {
  Table table{"", {"run", "status", "values", "worst, share of tolerance", "of"}, {}, 1};
  for (const Json& run : regression["runs"]) {
    const std::string worst = run["worst"];
    table.rows.push_back({run["name"], run["status"], fmt::format("{}", run["compared"].get<std::size_t>()),
                          worst.empty() ? "-" : show_share(run["worst_share_of_tolerance"]), worst});
  }
  return table;
}

Page make_regress_page(const Json& regression) {
  const Json& runs = regression["runs"];
  std::size_t good = 0;
  std::vector<std::string> problems;
  Json names = Json::array();
  Json shares = Json::array();
  for (const Json& run : runs) {
    const std::string name = run["name"];
    const std::string status = run["status"];
    if (status == "same" || status == "updated") ++good;
    for (const Json& problem : run["problems"]) problems.push_back(name + ": " + problem.get<std::string>());
    names.push_back(name);
    shares.push_back(
        run["worst_share_of_tolerance"].is_null() ? Json() : rounded(run["worst_share_of_tolerance"].get<double>()));
  }
  const bool is_good = good == runs.size();
  Page page{"regress", "Regression runs against their goldens", format_count(runs.size(), "run")};
  Section verdict{"Verdict"};
  verdict.blocks.push_back(make_lead(
      is_good ? "good" : "bad",
      is_good ? fmt::format("As their goldens: {}.", format_count(runs.size(), "run"))
              : fmt::format("{} of {} differ from the golden.", runs.size() - good, format_count(runs.size(), "run"))));
  verdict.blocks.push_back(make_bars({"Worst difference of each run", "of its tolerance"}, names,
                                     Json::array({{{"name", "worst"}, {"values", shares}}}),
                                     "A run differs where its bar is above 1."));
  verdict.blocks.push_back(make_table(make_regress_table(regression)));
  page.add(std::move(verdict));
  if (!problems.empty()) page.add({"What differs", "", {{{"type", "text"}, {"items", problems}}}});
  return page;
}

}  // namespace rollrig::report
