#include "estimation/road_load/coastdown_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/math/constants/constants.hpp>

#include "estimation/road_load/coastdown_recording.h"
#include "sim/core/csv.h"
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
    {{"slope", between(-0.2, 0.2), ""}, &CoastdownConditions::slope}};
const std::vector<std::string> kTraceColumns{"time_s", "speed_km_h", "run", "session", "heading"};
const std::vector<std::string> kBinColumns{"v_hi_kmh", "v_lo_kmh",   "dt_s",   "run",         "use",       "heading",
                                           "session",  "start_time", "dist_m", "run_total_s", "run_dist_m"};
constexpr double kPerKmh = 1.0 / 3.6;  // "kmh" of the bins' columns is not a suffix that unit_of_key knows

/// "13:29:42.5" or seconds; none where the cell is empty.
std::optional<double> read_start_s(const CsvTable& table, std::size_t row, const std::string& cell) {
  const std::string text = boost::algorithm::trim_copy(cell);
  if (text.empty()) return std::nullopt;
  std::vector<std::string> parts;
  boost::algorithm::split(parts, text, [](char c) { return c == ':'; });
  double seconds = 0.0;
  for (const std::string& part : parts) {
    const std::optional<double> number = parse_number(part);
    const bool is_first = &part == &parts.front();
    if (parts.size() > 3 || !number.has_value() || *number < 0.0 || (!is_first && *number >= 60.0)) {
      throw table.cell_error(row, "start_time", fmt::format("'{}' is not a time of day", text),
                             "hours:minutes:seconds such as 13:29:42.5, or seconds; or an empty field");
    }
    seconds = 60.0 * seconds + *number;
  }
  return seconds;
}

/// Cells of an optional column; empty strings where it is absent.
std::vector<std::string> text_or_empty(const CsvTable& table, const std::string& column) {
  return table.has(column) ? table.text(column) : std::vector<std::string>(table.row_count());
}

std::vector<std::string> add_condition_columns(std::vector<std::string> columns) {
  for (const ConditionColumn& column : kConditionColumns) columns.emplace_back(column.field.key);
  return columns;
}

/// Of all rows of a file.
CoastdownConditions read_conditions(const CsvTable& table) {
  CoastdownConditions conditions;
  for (const auto& [field, values] : kConditionColumns) {
    if (table.has(field.key)) conditions.*values = table.numbers(field);
  }
  return conditions;
}

void add_conditions(const CoastdownConditions& of_rows, std::size_t row, CoastdownConditions& to) {
  for (const auto& [field, values] : kConditionColumns) {
    if (!(of_rows.*values).empty()) (to.*values).push_back((of_rows.*values)[row]);
  }
}

/// Rows sorted into runs, in the order in which the runs begin.
class RunSorter {
 public:
  RunSorter(const CsvTable& table, CoastdownData& data) : table_(table), data_(data) {
    runs_ = text_or_empty(table, "run");
    headings_ = text_or_empty(table, "heading");
    for (const char* column : {"session", "file", "test_date"}) {
      if (!table.has(column)) continue;
      sessions_ = table.text(column);
      break;
    }
    sessions_.resize(table.row_count());
  }

  /// The run of a row; `begins` starts a new one where the file has no `run` column.
  CoastdownRun& run_of(std::size_t row, bool begins) {
    if (!table_.has("run") && begins) ++unnamed_;
    const std::string id = table_.has("run") ? runs_[row] : fmt::format("{}", unnamed_);
    const auto [it, is_new] = index_.try_emplace({sessions_[row], id}, data_.runs.size());
    if (is_new) {
      data_.runs.emplace_back();
      data_.runs.back().id = id;
      data_.runs.back().session = sessions_[row];
    }
    CoastdownRun& run = data_.runs[it->second];
    if (!table_.has("heading")) return run;
    const int heading = read_heading(row);
    if (!is_new && heading != run.heading) {
      throw table_.cell_error(row, "heading", fmt::format("run '{}' changes its heading", id), "one heading a run");
    }
    run.heading = heading;
    return run;
  }

 private:
  /// "+" and "-" as they are; degrees against the first heading of the file.
  int read_heading(std::size_t row) {
    const std::string text = boost::algorithm::trim_copy(headings_[row]);
    if (text == "+" || text == "+1") return +1;
    if (text == "-" || text == "-1" || text == "\xE2\x88\x92") return -1;  // the last is the minus sign of typesetting
    const std::optional<double> degrees = parse_number(text);
    if (!degrees.has_value()) throw table_.cell_error(row, "heading", "not a heading", "+ or -, or degrees");
    if (!first_heading_deg_.has_value()) first_heading_deg_ = *degrees;
    return std::cos((*degrees - *first_heading_deg_) * boost::math::constants::degree<double>()) >= 0.0 ? +1 : -1;
  }

  const CsvTable& table_;
  CoastdownData& data_;
  std::vector<std::string> runs_, headings_, sessions_;
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
  std::optional<double> first_heading_deg_;
  int unnamed_ = 0;
};

void require_falling(const CsvTable& table, const CoastdownRun& run) {
  constexpr double kLeastFall_m_s = 1.0 / 3.6;
  const auto top = std::max_element(run.speed_m_s.begin(), run.speed_m_s.end());
  const auto after = std::min_element(top, run.speed_m_s.end());
  if (*top - *after >= kLeastFall_m_s) return;
  throw InputError({fmt::format("the speed of run '{}' does not fall", run.id), table.path(), 0, "speed_km_h",
                    fmt::format("{:.4g} to {:.4g} km/h", 3.6 * run.speed_m_s.front(), 3.6 * run.speed_m_s.back()),
                    "a coastdown: a speed that falls with time", ""});
}

void read_trace(const CsvTable& table, CoastdownFile& file) {
  table.require_known(add_condition_columns(kTraceColumns));
  const std::vector<double> times = table.numbers({"time_s", any_number(), ""});
  const std::vector<double> speeds = table.numbers({"speed_km_h", between(0.0, 500.0), ""});
  const CoastdownConditions conditions = read_conditions(table);
  RunSorter sorter(table, file.data);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    CoastdownRun& run = sorter.run_of(row, row == 0);
    if (!run.time_s.empty() && times[row] <= run.time_s.back()) {
      throw table.cell_error(
          row, "time_s",
          fmt::format("time does not increase within run '{}': {} after {}", run.id, times[row], run.time_s.back()),
          fmt::format("more than {}", run.time_s.back()));
    }
    run.time_s.push_back(times[row]);
    run.speed_m_s.push_back(speeds[row]);
    add_conditions(conditions, row, run.conditions);
  }
  bool one_clock = true;
  for (std::size_t i = 0; i < file.data.runs.size(); ++i) {
    require_falling(table, file.data.runs[i]);
    one_clock = one_clock && (i == 0 || file.data.runs[i].time_s.front() > file.data.runs[i - 1].time_s.back());
  }
  for (CoastdownRun& run : file.data.runs) {
    if (one_clock) run.start_s = run.time_s.front();
  }
}

void require_order(const CsvTable& table, std::size_t row, const CoastdownRun& run, double high, double low) {
  if (low >= high) {
    throw table.cell_error(row, "v_lo_kmh", "the bin does not fall: v_lo_kmh >= v_hi_kmh",
                           fmt::format("less than v_hi_kmh = {:.6g}", high));
  }
  if (!run.bins.empty() && high * kPerKmh > run.bins.back().low_m_s + 1e-6) {
    throw table.cell_error(row, "v_hi_kmh", fmt::format("bins of run '{}' overlap or rise", run.id),
                           fmt::format("at most {:.6g}, the end of the bin before", 3.6 * run.bins.back().low_m_s));
  }
}

/// Totals of a run, beside its bins: of the run, or bin by bin.
class RunTotals {
 public:
  explicit RunTotals(const CsvTable& table) {
    if (table.has("run_total_s")) totals_s_ = table.numbers({"run_total_s", between(0.0, 1e9), ""}, true);
    if (table.has("run_dist_m")) distances_m_ = table.numbers({"run_dist_m", between(0.0, 1e9), ""}, true);
    if (table.has("dist_m")) bin_distances_m_ = table.numbers({"dist_m", between(0.0, 1e9), ""}, true);
  }

  void add(std::size_t row, CoastdownRun& run) const {
    if (!totals_s_.empty()) put(totals_s_[row], run.total_s);
    if (!distances_m_.empty()) {
      put(distances_m_[row], run.distance_m);
    } else if (!bin_distances_m_.empty()) {
      put(run.distance_m.value_or(0.0) + bin_distances_m_[row], run.distance_m);
    }
  }

 private:
  /// An empty cell says nothing, and neither does 0.
  static void put(double value, std::optional<double>& to) {
    if (value > 0.0) to = value;
  }
  std::vector<double> totals_s_, distances_m_, bin_distances_m_;
};

bool is_on(const CsvTable& table, std::size_t row, const std::string& cell) {
  const std::string word = boost::algorithm::to_lower_copy(boost::algorithm::trim_copy(cell));
  if (word == "on" || word == "yes" || word == "1" || word == "true") return true;
  if (word == "off" || word == "no" || word == "0" || word == "false") return false;
  throw table.cell_error(row, "use", "not a value of 'use'", "On or Off");
}

/// Totals of a run are not those of its bins where some of them are Off.
void drop_incomplete_totals(const CsvTable& table, const std::vector<std::string>& uses, CoastdownData& data) {
  if (!table.has("use")) return;
  const std::vector<std::string> ids = text_or_empty(table, "run");
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (is_on(table, row, uses[row])) continue;
    for (CoastdownRun& run : data.runs) {
      if (table.has("run") && run.id != ids[row]) continue;
      run.total_s.reset();
      run.distance_m.reset();
    }
  }
}

void read_bins(const CsvTable& table, CoastdownFile& file) {
  const std::vector<double> highs = table.numbers({"v_hi_kmh", between(0.0, 500.0), ""});
  const std::vector<double> lows = table.numbers({"v_lo_kmh", between(0.0, 500.0), ""});
  const std::vector<double> durations = table.numbers({"dt_s", positive(), ""});
  const std::vector<std::string> uses = text_or_empty(table, "use");
  const std::vector<std::string> starts = text_or_empty(table, "start_time");
  const CoastdownConditions conditions = read_conditions(table);
  const RunTotals totals(table);
  const std::vector<std::string> known = add_condition_columns(kBinColumns);
  for (const std::string& column : table.columns()) {
    if (std::find(known.begin(), known.end(), column) == known.end()) file.ignored_columns.push_back(column);
  }
  RunSorter sorter(table, file.data);
  double last_high = -1.0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const bool begins = last_high < 0.0 || highs[row] >= last_high;
    last_high = highs[row];
    if (table.has("use") && !is_on(table, row, uses[row])) {
      ++file.rows_off;
      continue;
    }
    CoastdownRun& run = sorter.run_of(row, begins);
    require_order(table, row, run, highs[row], lows[row]);
    const std::optional<double> start_s = read_start_s(table, row, starts[row]);
    if (!run.start_s.has_value()) run.start_s = start_s;
    run.bins.push_back({highs[row] * kPerKmh, lows[row] * kPerKmh, durations[row]});
    totals.add(row, run);
    add_conditions(conditions, row, run.conditions);
  }
  drop_incomplete_totals(table, uses, file.data);
}

}  // namespace

CoastdownFile read_coastdowns(const std::string& path) {
  if (std::filesystem::is_directory(path)) return read_coastdown_recording(path);
  const CsvTable table = CsvTable::read(path);
  if (table.has("phase")) return read_coastdown_recording(path);
  CoastdownFile file;
  file.is_trace = table.has("time_s") || table.has("speed_km_h");
  if (file.is_trace) {
    read_trace(table, file);
    return file;
  }
  if (!table.has("v_hi_kmh") && !table.has("v_lo_kmh") && !table.has("dt_s")) {
    throw InputError({"neither a speed trace nor times through speed bins", path, 1, "", "",
                      "columns time_s and speed_km_h, or v_hi_kmh, v_lo_kmh and dt_s", ""});
  }
  read_bins(table, file);
  return file;
}

}  // namespace rollrig::estimation
