#include "validation/generator/planned_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <cmath>
#include <filesystem>
#include <map>

#include "validation/generator/draws.h"
#include "validation/generator/output.h"
#include "validation/generator/problem.h"

namespace fs = std::filesystem;

namespace blind {
namespace {

using Json = nlohmann::ordered_json;
using Table = std::map<std::string, std::vector<double>>;  // by column

constexpr const char* kFormat = "rollrig-blind-plan/1";

InputError problem(const std::string& what, const fs::path& file, const std::string& key, const std::string& value,
                   const std::string& allowed) {
  return InputError({fmt::format("{}: {}", file.string(), what), key, value, allowed, ""});
}

/// Columns that a plan of the kind must have, in any order.
std::vector<std::string> required_columns(Kind kind) {
  if (kind == Kind::kRoad) return {"time_s", "speed_km_h", "elevation_m", "ambient_degC"};
  std::vector<std::string> columns{"time_s", "speed_km_h", "load_N", "ambient_degC"};
  if (kind == Kind::kDyno) columns.emplace_back("longitudinal_force_N");
  return columns;
}

std::vector<std::string> split(const std::string& line, const char* at) {
  std::vector<std::string> parts;
  boost::algorithm::split(parts, line, boost::algorithm::is_any_of(at));
  return parts;
}

double read_cell(const std::string& cell, const std::string& column, const fs::path& file) {
  double value = 0.0;
  if (boost::conversion::try_lexical_convert(cell, value) && std::isfinite(value)) return value;
  throw problem("not a number", file, column, cell, "a number in every cell");
}

Table read_table(const fs::path& file, Kind kind) {
  std::vector<std::string> lines = split(read_whole(file.string()), "\n");
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  std::vector<std::string> names = split(lines.empty() ? "" : lines.front(), ",");
  Table table;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i], ",");
    if (cells.size() != names.size()) throw problem("a ragged row", file, "row", lines[i], lines.front());
    for (std::size_t k = 0; k < names.size(); ++k) table[names[k]].push_back(read_cell(cells[k], names[k], file));
  }
  const std::vector<std::string> required = required_columns(kind);
  for (const std::string& column : required) {
    if (table[column].size() >= 2) continue;
    throw problem(fmt::format("no column '{}' with two rows or more", column), file, column, "",
                  fmt::format("the given columns of a {} set: {}", name_of(kind), fmt::join(required, ", ")));
  }
  return table;
}

void check_rows(const Table& table, const fs::path& file) {
  const std::vector<double>& time_s = table.at("time_s");
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const bool goes_on = i == 0 ? time_s[i] == 0.0 : time_s[i] > time_s[i - 1];
    if (goes_on && time_s[i] == std::round(time_s[i])) continue;
    throw problem("times do not go on", file, "time_s", fmt::format("{:g}", time_s[i]),
                  "0 first, then whole seconds that increase");
  }
  for (const char* column : {"speed_km_h", "load_N"}) {
    const auto at = table.find(column);
    if (at == table.end()) continue;
    for (const double value : at->second) {
      if (value < 0.0) throw problem("less than nothing", file, column, fmt::format("{:g}", value), "0 or more");
    }
  }
}

/// A column that a test holds from its first row to its last.
double read_held(const Table& table, const char* column, const fs::path& file) {
  const std::vector<double>& values = table.at(column);
  for (const double value : values) {
    if (value != values.front()) throw problem("not held", file, column, fmt::format("{:g}", value), "one value");
  }
  return values.front();
}

/// Straight lines between rows, the load held, as legs; off the drum a leg lasts one second.
std::vector<Leg> make_legs(const Table& table, Kind kind, double road_load_N) {
  const std::vector<double>& time_s = table.at("time_s");
  const auto column = [&](const char* name) {
    const auto at = table.find(name);
    return at == table.end() ? std::vector<double>(time_s.size(), 0.0) : at->second;
  };
  const std::vector<double> speed_km_h = column("speed_km_h");
  const std::vector<double> load_N = column("load_N");
  const std::vector<double> pull_N = column("longitudinal_force_N");
  const std::vector<double> elevation_m = column("elevation_m");
  std::vector<Leg> legs;
  double way_m = 0.0;
  for (std::size_t i = 0; i + 1 < time_s.size(); ++i) {
    const double span_s = time_s[i + 1] - time_s[i];
    const double step_s = kind == Kind::kDrum ? span_s : 1.0;
    for (double from_s = 0.0; from_s < span_s; from_s += step_s) {
      const auto between = [&](const std::vector<double>& values, double at_s) {
        return values[i] + at_s / span_s * (values[i + 1] - values[i]);
      };
      const double to_s = from_s + step_s;
      Leg leg{time_s[i] + from_s, step_s, between(speed_km_h, from_s) / 3.6, between(speed_km_h, to_s) / 3.6,
              kind == Kind::kRoad ? road_load_N : load_N[i]};
      leg.start_longitudinal_N = between(pull_N, from_s);
      leg.end_longitudinal_N = between(pull_N, to_s);
      leg.start_elevation_m = between(elevation_m, from_s);
      leg.end_elevation_m = between(elevation_m, to_s);
      leg.start_distance_m = way_m;
      way_m += leg.mean_m_s() * step_s;
      legs.push_back(leg);
    }
  }
  return legs;
}

RunPlan read_run(const fs::path& folder, const Json& json, const SetOrder& order, double road_load_N) {
  const fs::path file = folder / json.at("file").get<std::string>();
  const Table table = read_table(file, order.kind);
  check_rows(table, file);
  RunPlan run;
  run.id = json.at("id").get<std::string>();
  run.session = json.at("session").get<std::string>();
  run.cold_pressure_kPa = json.at("cold_pressure_kPa").get<double>();
  run.reversed = json.value("reversed", false);
  run.reads_zero = json.at("force_at_standstill").get<bool>();
  for (const Json& span : json.at("not_read_s")) {
    run.unread_s.emplace_back(span.at(0).get<double>(), span.at(1).get<double>());
  }
  if (table.count("surface_temperature_degC") > 0)
    run.surface_degC = read_held(table, "surface_temperature_degC", file);
  const auto hung = table.find("hung_torque_Nm");
  for (std::size_t i = 0; hung != table.end() && i < hung->second.size(); ++i) {
    run.hung_Nm.emplace_back(table.at("time_s")[i], hung->second[i]);
  }
  Draws own(order.seed, "run/" + run.id);
  run.air = draw_air(own, read_held(table, "ambient_degC", file));
  run.initial_degC = std::round(10.0 * run.air.at(0.0)) / 10.0;
  run.legs = make_legs(table, order.kind, road_load_N);
  return run;
}

}  // namespace

TestPlan read_test_plan(const std::string& folder, const SetOrder& order, double road_load_N) {
  const fs::path file = fs::path(folder) / "plan.json";
  TestPlan plan;
  try {
    const Json json = Json::parse(read_whole(file.string()));
    if (json.at("format") != kFormat) throw problem("not a plan", file, "format", json.at("format").dump(), kFormat);
    if (json.at("kind") != name_of(order.kind)) {
      throw problem("a plan for another kind of set", file, "kind", json.at("kind").dump(), name_of(order.kind));
    }
    plan.set_sha256 = json.at("set_sha256").get<std::string>();
    for (const Json& run : json.at("runs")) plan.runs.push_back(read_run(folder, run, order, road_load_N));
  } catch (const Json::exception& error) {
    throw problem(fmt::format("not a plan: {}", error.what()), file, "plan.json", "", kFormat);
  }
  if (plan.runs.empty()) throw problem("a plan without runs", file, "runs", "[]", "one run or more");
  return plan;
}

}  // namespace blind
