#include "report/list_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/blocks.h"
#include "scenarios/run/scenario.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

/// Settings that are varied, in their order.
std::vector<std::string> find_axes(const Json& sweep) {
  std::vector<std::string> axes;
  for (const auto& [key, value] : sweep["points"].front()["set"].items()) axes.push_back(key);
  return axes;
}

/// Moves what the scenario declares as headlines to the front, in the order of the declarations.
void put_headlines_first(const Json& sweep, std::vector<std::string>& keys) {
  const scenarios::Scenario* scenario = scenarios::find_scenario_if_any(sweep["scenario"].get<std::string>());
  if (scenario == nullptr) return;
  const auto& headlines = scenario->headlines;
  const auto rank = [&headlines](const std::string& key) {
    return std::find_if(headlines.begin(), headlines.end(), [&key](const auto& one) { return one.first == key; }) -
           headlines.begin();
  };
  std::stable_sort(keys.begin(), keys.end(),
                   [&rank](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
}

/// Not of a list.
bool is_alone(const std::string& key) { return key.find('.') == std::string::npos; }

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
  put_headlines_first(sweep, keys);
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

namespace {

/// Of a tolerance; beyond all where that is 0.
std::string show_share(const Json& share) {
  return share.is_null() ? "none allowed" : fmt::format("{:.2g}", share.get<double>());
}

/// "motor power at 1082 s" of "motor_power_W at 1082 s".
std::string name_quantity(const std::string& text) {
  const std::size_t end = text.find(' ');
  return plain_name(text.substr(0, end)) + (end == std::string::npos ? "" : text.substr(end));
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

namespace {

/// Statuses of runs of which nothing says that they are wrong.
bool is_doubtful(const std::string& status) { return status == "no golden"; }

/// What the page says of so many runs with a status.
std::string describe_status(const std::string& status, std::size_t count) {
  if (!is_doubtful(status)) return fmt::format("{}: {}", status, count);
  return fmt::format("{} {} no stored result yet", count, count == 1 ? "has" : "have");
}

/// Worst difference of each run that was compared; the axis goes to 1 at least, from which on a run differs.
Block make_regress_bars(const Json& names, const Json& shares) {
  Block bars = make_bars({"Worst difference from the stored result", "of its tolerance", true}, names,
                         Json::array({{{"name", "worst"}, {"values", shares}}}),
                         "A run differs where its bar is above 1. Runs without a stored result have no bar.");
  bars["least_end"] = 1.0;
  Json labels = Json::array();
  for (const Json& share : shares) labels.push_back(show_share(share));
  bars["series"][0]["labels"] = labels;
  return bars;
}

}  // namespace

Page make_regress_page(const Json& regression) {
  const Json& runs = regression["runs"];
  std::size_t good = 0;
  std::size_t doubtful = 0;
  std::vector<std::pair<std::string, std::size_t>> others;  // status and how many, in their order
  double most = 0.0;                                        // share of the tolerance
  std::vector<std::string> problems;
  Json names = Json::array();
  Json shares = Json::array();
  for (const Json& run : runs) {
    const std::string name = run["name"];
    const std::string status = run["status"];
    if (status == "same" || status == "updated") {
      ++good;
    } else {
      const auto known =
          std::find_if(others.begin(), others.end(), [&](const auto& one) { return one.first == status; });
      known == others.end() ? others.emplace_back(status, 1) : (++known->second, *known);
    }
    if (is_doubtful(status)) ++doubtful;
    for (const Json& problem : run["problems"]) problems.push_back(name + ": " + problem.get<std::string>());
    if (run["compared"] == 0) continue;  // nothing to draw
    names.push_back(name);
    const Json share = run["worst_share_of_tolerance"];
    shares.push_back(share.is_null() ? Json() : rounded(share.get<double>()));
    if (!share.is_null()) most = std::max(most, share.get<double>());
  }
  const bool is_wrong = good + doubtful < runs.size();
  const char* tone = is_wrong ? "bad" : doubtful > 0 ? "doubt" : "good";
  Page page{"regress", "Regression runs against their stored results (goldens)", format_count(runs.size(), "run")};
  Section verdict{"Verdict"};
  std::string text =
      fmt::format("{} of {} give the values of their stored results", good, format_count(runs.size(), "run"));
  if (!is_wrong && doubtful > 0) text = "No run differs; " + text;
  for (const auto& [status, count] : others) text += "; " + describe_status(status, count);
  verdict.blocks.push_back(make_lead(tone, text + "."));
  std::vector<Tile> tiles{{"As their stored results",
                           fmt::format("{} of {}", good, runs.size()),
                           "",
                           "runs",
                           is_wrong   ? "bad"
                           : good > 0 ? "good"
                                      : "",
                           {}}};
  for (const auto& [status, count] : others) {
    tiles.push_back({is_doubtful(status) ? "No stored result" : capitalized(status),
                     fmt::format("{}", count),
                     "",
                     is_doubtful(status) ? "of the runs; regress --update stores theirs" : "of the runs",
                     is_doubtful(status) ? "doubt" : "bad",
                     {}});
  }
  verdict.blocks.push_back(make_tiles(tiles));
  if (most > 0.0) verdict.blocks.push_back(make_regress_bars(names, shares));
  Table table = make_regress_table(regression);
  for (std::vector<std::string>& row : table.rows) {
    row.back() = name_quantity(row.back());
    if (is_doubtful(row[1])) row[1] = "no stored result";
  }
  verdict.blocks.push_back(make_table(table));
  page.add(std::move(verdict));
  if (!problems.empty())
    page.add({is_wrong ? "What differs" : "What is missing", "", {{{"type", "text"}, {"items", problems}}}});
  return page;
}

}  // namespace rollrig::report
