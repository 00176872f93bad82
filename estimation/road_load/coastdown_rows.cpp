#include "estimation/road_load/coastdown_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <boost/algorithm/string/trim.hpp>
#include <boost/math/constants/constants.hpp>

#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

struct ConditionColumn {
  Field field;
  std::vector<double> CoastdownConditions::*values;
};
const std::vector<ConditionColumn> kConditionColumns{
    {{"ambient_degC", between(-50.0, 60.0), ""}, &CoastdownConditions::ambient_K},
    {{"ambient_pressure_kPa", between(50.0, 110.0), ""}, &CoastdownConditions::ambient_pressure_Pa},
    {{"wind_m_s", between(-40.0, 40.0), ""}, &CoastdownConditions::wind_m_s},
    {{"crosswind_m_s", between(-40.0, 40.0), ""}, &CoastdownConditions::crosswind_m_s},
    {{"slope", between(-0.2, 0.2), ""}, &CoastdownConditions::slope},
    {{"air_speed_km_h", between(0.0, 500.0), ""}, &CoastdownConditions::air_speed_m_s},
    {{"yaw_deg", between(-180.0, 180.0), ""}, &CoastdownConditions::yaw_rad}};

std::vector<std::string> read_sessions(const CsvTable& table) {
  for (const char* column : {"session", "file", "test_date"}) {
    if (table.has(column)) return table.text(column);
  }
  return std::vector<std::string>(table.row_count());
}

/// Throws InputError where headings are a code, such as 1 and 2: as degrees, all would be one heading.
void require_degrees(const CsvTable& table, const std::vector<std::string>& cells) {
  constexpr double kMostCode = 4.0;  // Assumed
  std::set<double> values;
  std::size_t row = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string text = boost::algorithm::trim_copy(cells[i]);
    const std::optional<double> value = parse_number(text);
    if (!value.has_value() || text[0] == '+' || text[0] == '-' || *value != std::round(*value)) return;
    if (values.insert(*value).second && values.size() == 2) row = i;
  }
  if (values.size() < 2 || *values.rbegin() > kMostCode) return;
  throw table.cell_error(row, "heading",
                         fmt::format("{:g} and {:g} look like a code of the headings; as degrees they are one heading",
                                     *values.begin(), *values.rbegin()),
                         "+ or -, or degrees of the compass");
}

/// "+" and "-" as they are; degrees against the first heading of the file.
std::vector<int> read_headings(CheckedRows& rows) {
  std::vector<int> headings(rows.row_count(), 0);
  if (!rows.table().has("heading")) return headings;
  const std::vector<std::string> cells = rows.table().text("heading");
  require_degrees(rows.table(), cells);
  std::optional<double> first_deg;
  for (std::size_t row = 0; row < cells.size(); ++row) {
    const std::string text = boost::algorithm::trim_copy(cells[row]);
    const bool is_minus = text == "-" || text == "-1" || text == "\xE2\x88\x92";  // the last is that of typesetting
    headings[row] = text == "+" || text == "+1" ? +1 : is_minus ? -1 : 0;
    if (headings[row] != 0) continue;
    const std::optional<double> degrees = parse_number(text);
    if (!degrees.has_value()) {
      rows.leave_out(rows.table().cell_error(row, "heading", "not a heading", "+ or -, or degrees"));
      continue;
    }
    if (!first_deg.has_value()) first_deg = degrees;
    headings[row] = std::cos((*degrees - *first_deg) * boost::math::constants::degree<double>()) >= 0.0 ? +1 : -1;
  }
  return headings;
}

/// The heading of most rows of a run is that of the run; of as many, that of the first.
void settle_heading(CheckedRows& rows, const std::vector<int>& headings, RowsOfRun& run) {
  const auto at_first = [&](std::size_t row) { return headings[row] == headings[run.rows.front()]; };
  const auto same = static_cast<std::size_t>(std::count_if(run.rows.begin(), run.rows.end(), at_first));
  run.heading = 2 * same >= run.rows.size() ? headings[run.rows.front()] : -headings[run.rows.front()];
  for (const std::size_t row : run.rows) {
    if (headings[row] == run.heading) continue;
    rows.leave_out(rows.table().cell_error(row, "heading", fmt::format("run '{}' changes its heading", run.id),
                                           "one heading a run"));
  }
}

}  // namespace

CoastdownConditions read_conditions(CheckedRows& rows) {
  CoastdownConditions conditions;
  for (const auto& [field, values] : kConditionColumns) {
    if (rows.table().has(field.key)) conditions.*values = rows.numbers(field);
  }
  return conditions;
}

std::vector<std::string> list_condition_columns() {
  std::vector<std::string> columns;
  for (const ConditionColumn& column : kConditionColumns) columns.emplace_back(column.field.key);
  return columns;
}

void add_conditions(const CoastdownConditions& of_rows, std::size_t row, CoastdownConditions& to) {
  for (const auto& [field, values] : kConditionColumns) {
    if (!(of_rows.*values).empty()) (to.*values).push_back((of_rows.*values)[row]);
  }
}

std::vector<std::string> text_or_empty(const CsvTable& table, const std::string& column) {
  return table.has(column) ? table.text(column) : std::vector<std::string>(table.row_count());
}

void require_one_vehicle(const CsvTable& table) {
  const std::vector<std::string> names = text_or_empty(table, "vehicle");
  for (std::size_t row = 1; row < names.size(); ++row) {
    if (names[row] == names.front()) continue;
    throw table.cell_error(row, "vehicle", fmt::format("another vehicle than '{}' before it", names.front()),
                           "runs of one vehicle: a road load is that of one");
  }
}

std::vector<RowsOfRun> sort_into_runs(CheckedRows& rows, const std::vector<bool>& begins,
                                      const std::vector<bool>& used) {
  const bool has_names = rows.table().has("run");
  const std::vector<std::string> names = text_or_empty(rows.table(), "run");
  const std::vector<std::string> sessions = read_sessions(rows.table());
  const std::vector<int> headings = read_headings(rows);
  std::vector<RowsOfRun> runs;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  int unnamed = 0;
  for (std::size_t row = 0; row < rows.row_count(); ++row) {
    if (!has_names && begins[row]) ++unnamed;
    if (!used[row] || rows.is_out(row)) continue;
    const std::string id = has_names ? names[row] : fmt::format("{}", unnamed);
    const auto [at, is_new] = index.try_emplace({sessions[row], id}, runs.size());
    if (is_new) runs.push_back({id, sessions[row], 0, {}});
    runs[at->second].rows.push_back(row);
  }
  for (RowsOfRun& run : runs) settle_heading(rows, headings, run);
  return runs;
}

}  // namespace rollrig::estimation
