#include "estimation/road_load/coastdown_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>

#include "estimation/road_load/coastdown_recording.h"
#include "estimation/road_load/coastdown_rows.h"
#include "estimation/road_load/coastdown_units.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

const std::vector<std::string> kTraceColumns{"time_s", "speed_km_h", "run", "session", "heading", "vehicle"};
const std::vector<std::string> kBinColumns{"v_hi_kmh", "v_lo_kmh",   "dt_s",   "run",         "use",        "heading",
                                           "session",  "start_time", "dist_m", "run_total_s", "run_dist_m", "vehicle"};
constexpr double kPerKmh = 1.0 / 3.6;  // "kmh" of the bins' columns is not a suffix that unit_of_key knows

std::vector<std::string> add_condition_columns(std::vector<std::string> columns) {
  for (const std::string& column : list_condition_columns()) columns.push_back(column);
  return columns;
}

/// A run with its rows that can be used; none where it has none.
std::optional<CoastdownRun> begin_run(const CheckedRows& rows, RowsOfRun& of_run) {
  auto& used = of_run.rows;
  used.erase(std::remove_if(used.begin(), used.end(), [&rows](std::size_t row) { return rows.is_out(row); }),
             used.end());
  if (used.empty()) return std::nullopt;
  CoastdownRun run;
  run.id = of_run.id;
  run.session = of_run.session;
  run.heading = of_run.heading;
  return run;
}

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

void require_falling(const CsvTable& table, const CoastdownRun& run) {
  constexpr double kLeastFall_m_s = 1.0 / 3.6;
  const auto top = std::max_element(run.speed_m_s.begin(), run.speed_m_s.end());
  const auto after = std::min_element(top, run.speed_m_s.end());
  if (*top - *after >= kLeastFall_m_s) return;
  throw InputError({fmt::format("the speed of run '{}' does not fall", run.id), table.path(), 0, "speed_km_h",
                    fmt::format("{:.4g} to {:.4g} km/h", 3.6 * run.speed_m_s.front(), 3.6 * run.speed_m_s.back()),
                    "a coastdown: a speed that falls with time", ""});
}

void read_trace(CheckedRows& rows, BadRows bad_rows, CoastdownFile& file) {
  const CsvTable& table = rows.table();
  table.require_known(add_condition_columns(kTraceColumns));
  const std::vector<double> times = rows.numbers({"time_s", any_number(), ""});
  const std::vector<double> speeds = rows.numbers({"speed_km_h", between(0.0, 500.0), ""});
  const CoastdownConditions conditions = read_conditions(rows);
  std::vector<bool> begins(rows.row_count(), false);
  if (!begins.empty()) begins.front() = true;
  std::vector<RowsOfRun> runs = sort_into_runs(rows, begins, std::vector<bool>(rows.row_count(), true));
  for (const RowsOfRun& run : runs)
    rows.check_times("time_s", run.rows, times, fmt::format(" within run '{}'", run.id));
  file.left_out = rows.settle(bad_rows);
  for (RowsOfRun& of_run : runs) {
    std::optional<CoastdownRun> run = begin_run(rows, of_run);
    if (!run.has_value()) continue;
    for (const std::size_t row : of_run.rows) {
      run->time_s.push_back(times[row]);
      run->speed_m_s.push_back(speeds[row]);
      add_conditions(conditions, row, run->conditions);
    }
    file.data.runs.push_back(std::move(*run));
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

/// Speeds of the bins, in km/h as they are written.
struct BinSpeeds {
  std::vector<double> high, low;
};

/// Notes bins that do not fall, and such that are out of the order of their run, or overlap the one before.
void check_bins(CheckedRows& rows, const BinSpeeds& speeds, const std::vector<RowsOfRun>& runs) {
  std::vector<double> middles(rows.row_count());
  for (std::size_t row = 0; row < middles.size(); ++row) middles[row] = -0.5 * (speeds.high[row] + speeds.low[row]);
  const auto overlap = [&](std::size_t row, const RowsOfRun& run, const std::string& allowed) {
    rows.leave_out(
        rows.table().cell_error(row, "v_hi_kmh", fmt::format("bins of run '{}' overlap or rise", run.id), allowed));
  };
  for (const RowsOfRun& run : runs) {
    for (const CheckedRows::Disorder& found : rows.find_disorder(run.rows, middles)) {
      overlap(found.row, run,
              found.is_below ? fmt::format("at most {:.6g}, the end of the bin before", speeds.low[found.other])
                             : fmt::format("a bin above {:.6g}, where the next one begins", speeds.high[found.other]));
    }
    std::optional<std::size_t> before;
    for (const std::size_t row : run.rows) {
      if (rows.is_out(row)) continue;
      if (before.has_value() && speeds.high[row] > speeds.low[*before] + 3.6e-6) {
        overlap(row, run, fmt::format("at most {:.6g}, the end of the bin before", speeds.low[*before]));
        continue;
      }
      before = row;
    }
  }
}

/// Speeds at which bins end; a bin that does not fall is noted.
BinSpeeds read_bin_speeds(CheckedRows& rows) {
  BinSpeeds speeds{rows.numbers({"v_hi_kmh", between(0.0, 500.0), ""}),
                   rows.numbers({"v_lo_kmh", between(0.0, 500.0), ""})};
  for (std::size_t row = 0; row < rows.row_count(); ++row) {
    if (rows.is_out(row) || speeds.low[row] < speeds.high[row]) continue;
    rows.leave_out(rows.table().cell_error(row, "v_lo_kmh", "the bin does not fall: v_lo_kmh >= v_hi_kmh",
                                           fmt::format("less than v_hi_kmh = {:.6g}", speeds.high[row])));
  }
  return speeds;
}

/// Without a `run` column, a run begins where the speed does not fall on.
std::vector<bool> find_begins(const CheckedRows& rows, const BinSpeeds& speeds) {
  std::vector<bool> begins(rows.row_count(), false);
  std::optional<double> last_high;
  for (std::size_t row = 0; row < rows.row_count(); ++row) {
    if (rows.is_out(row)) continue;
    begins[row] = !last_high.has_value() || speeds.high[row] >= *last_high;
    last_high = speeds.high[row];
  }
  return begins;
}

/// Totals of a run, beside its bins: of the run, or bin by bin.
class RunTotals {
 public:
  explicit RunTotals(CheckedRows& rows) {
    const auto read = [&rows](const char* column) {
      return rows.table().has(column) ? rows.spare_numbers({column, between(0.0, 1e9), ""}) : std::vector<double>();
    };
    totals_s_ = read("run_total_s");
    distances_m_ = read("run_dist_m");
    bin_distances_m_ = read("dist_m");
  }

  void add(const std::vector<std::size_t>& rows, CoastdownRun& run) const {
    double sum_m = 0.0;
    for (const std::size_t row : rows) {
      if (!totals_s_.empty()) put(totals_s_[row], run.total_s);
      if (!distances_m_.empty()) put(distances_m_[row], run.distance_m);
      if (!bin_distances_m_.empty()) sum_m += bin_distances_m_[row];  // NaN, and so none, where one is not known
    }
    if (distances_m_.empty()) put(sum_m, run.distance_m);
  }

 private:
  /// An empty cell says nothing, and neither does 0.
  static void put(double value, std::optional<double>& to) {
    if (value > 0.0) to = value;
  }
  std::vector<double> totals_s_, distances_m_, bin_distances_m_;
};

/// Which rows `use` leaves in; all without that column.
std::vector<bool> read_uses(CheckedRows& rows) {
  std::vector<bool> uses(rows.row_count(), true);
  if (!rows.table().has("use")) return uses;
  const std::vector<std::string> cells = rows.table().text("use");
  for (std::size_t row = 0; row < cells.size(); ++row) {
    const std::string word = boost::algorithm::to_lower_copy(boost::algorithm::trim_copy(cells[row]));
    if (word == "on" || word == "yes" || word == "1" || word == "true") continue;
    uses[row] = false;
    if (word == "off" || word == "no" || word == "0" || word == "false") continue;
    rows.leave_out(rows.table().cell_error(row, "use", "not a value of 'use'", "On or Off"));
  }
  return uses;
}

/// Times of day of the rows; a wrong one counts as an empty field.
std::vector<std::optional<double>> read_starts(CheckedRows& rows) {
  const std::vector<std::string> cells = text_or_empty(rows.table(), "start_time");
  std::vector<std::optional<double>> starts_s(cells.size());
  for (std::size_t row = 0; row < cells.size(); ++row) {
    try {
      starts_s[row] = read_start_s(rows.table(), row, cells[row]);
    } catch (const InputError& error) {
      rows.leave_empty(error);
    }
  }
  return starts_s;
}

/// Totals of a run are not those of its bins where some of them are left out. A row whose fields are not known may
/// belong to any run.
void drop_incomplete_totals(const CheckedRows& rows, const std::vector<bool>& uses, CoastdownFile& file) {
  const CsvTable& table = rows.table();
  const std::vector<std::string> ids = text_or_empty(table, "run");
  const auto drop = [&file](const auto& is_of) {
    for (CoastdownRun& run : file.data.runs) {
      if (!is_of(run)) continue;
      run.total_s.reset();
      run.distance_m.reset();
    }
  };
  if (rows.has_ragged()) drop([](const CoastdownRun&) { return true; });
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (uses[row] && !rows.is_out(row)) continue;
    drop([&](const CoastdownRun& run) { return !table.has("run") || run.id == ids[row]; });
  }
}

/// Letters and digits of a name, in lower case.
std::string strip_name(const std::string& name) {
  std::string stripped;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) stripped += c;
  }
  return boost::algorithm::to_lower_copy(stripped);
}

/// The column that another name means: the same but for blanks, case and underscores, or a condition in another unit.
/// Empty where there is none.
std::string find_meant_column(const std::string& name, const std::vector<std::string>& known) {
  const std::string stripped = strip_name(name);
  for (const std::string& column : known) {
    if (strip_name(column) == stripped) return column;
  }
  std::string meant;
  std::size_t longest = 0;
  for (const std::string& column : list_condition_columns()) {
    const std::string stem = strip_name(name_without_unit(column));
    if (stem.size() <= longest || stripped.rfind(stem, 0) != 0) continue;
    longest = stem.size();
    meant = column;
  }
  return meant;
}

/// Lists columns that the form does not have. Throws InputError for one whose name is nearly one that it has.
std::vector<std::string> list_ignored_columns(const CsvTable& table) {
  const std::vector<std::string> known = add_condition_columns(kBinColumns);
  std::vector<std::string> ignored;
  for (const std::string& column : table.columns()) {
    if (std::find(known.begin(), known.end(), column) != known.end()) continue;
    const std::string meant = find_meant_column(column, known);
    if (!meant.empty() && !table.has(meant)) {
      throw InputError({fmt::format("the column '{}' is not read", column), table.path(), 1, column, "",
                        fmt::format("'{}', spelled so and in its unit; a column of another content needs another name",
                                    meant),
                        meant});
    }
    ignored.push_back(column);
  }
  return ignored;
}

void read_bins(CheckedRows& rows, BadRows bad_rows, CoastdownFile& file) {
  file.ignored_columns = list_ignored_columns(rows.table());
  const BinSpeeds speeds = read_bin_speeds(rows);
  const std::vector<double> durations = rows.numbers({"dt_s", positive(), ""});
  const std::vector<bool> uses = read_uses(rows);
  const std::vector<std::optional<double>> starts_s = read_starts(rows);
  const CoastdownConditions conditions = read_conditions(rows);
  const RunTotals totals(rows);
  std::vector<RowsOfRun> runs = sort_into_runs(rows, find_begins(rows, speeds), uses);
  check_bins(rows, speeds, runs);
  file.left_out = rows.settle(bad_rows);
  for (std::size_t row = 0; row < rows.row_count(); ++row) file.rows_off += uses[row] || rows.is_out(row) ? 0 : 1;
  for (RowsOfRun& of_run : runs) {
    std::optional<CoastdownRun> run = begin_run(rows, of_run);
    if (!run.has_value()) continue;
    for (const std::size_t row : of_run.rows) {
      if (!run->start_s.has_value()) run->start_s = starts_s[row];
      run->bins.push_back({speeds.high[row] * kPerKmh, speeds.low[row] * kPerKmh, durations[row]});
      add_conditions(conditions, row, run->conditions);
    }
    totals.add(of_run.rows, *run);
    file.data.runs.push_back(std::move(*run));
  }
  drop_incomplete_totals(rows, uses, file);
}

CoastdownFile read_coastdown_rows(const std::string& path, BadRows bad_rows) {
  if (std::filesystem::is_directory(path)) return read_coastdown_recording(path, bad_rows);
  CheckedRows rows(path);
  const CsvTable& table = rows.table();
  if (table.has("phase")) return read_coastdown_recording(path, bad_rows);
  require_one_vehicle(table);
  CoastdownFile file;
  file.path = path;
  file.is_trace = table.has("time_s") || table.has("speed_km_h");
  if (file.is_trace) {
    read_trace(rows, bad_rows, file);
    return file;
  }
  if (!table.has("v_hi_kmh") && !table.has("v_lo_kmh") && !table.has("dt_s")) {
    throw InputError({"neither a speed trace nor times through speed bins", path, 1, "", "",
                      "columns time_s and speed_km_h, or v_hi_kmh, v_lo_kmh and dt_s", ""});
  }
  read_bins(rows, bad_rows, file);
  return file;
}

}  // namespace

CoastdownFile read_coastdowns(const std::string& path, BadRows bad_rows) {
  CoastdownFile file = read_coastdown_rows(path, bad_rows);
  require_coasting_decelerations(file);
  return file;
}

std::vector<std::string> doubt_vehicle(const CoastdownFile& file, const std::optional<double>& mass_kg,
                                       const std::optional<double>& drag_area_m2) {
  constexpr double kSame = 0.02;  // Assumed: what masses of one vehicle differ by
  std::vector<std::string> doubts;
  if (!file.vehicle.has_value()) return doubts;
  const auto differ = [](double given, double recorded) { return std::abs(given / recorded - 1.0) > kSame; };
  if (mass_kg.has_value() && differ(*mass_kg, file.vehicle->mass_kg)) {
    doubts.push_back(
        fmt::format("--mass is {:g} kg, but the manifest beside the recording has a vehicle of {:g} kg: all forces are "
                    "in proportion to the mass",
                    *mass_kg, file.vehicle->mass_kg));
  }
  if (drag_area_m2.has_value() && differ(*drag_area_m2, file.vehicle->drag_area_m2)) {
    doubts.push_back(fmt::format("--drag-area is {:g} m2, but the manifest beside the recording has {:g} m2",
                                 *drag_area_m2, file.vehicle->drag_area_m2));
  }
  return doubts;
}

std::vector<std::string> list_reading_warnings(const CoastdownFile& file) {
  std::vector<std::string> warnings;
  if (file.rows_off > 0) warnings.push_back(format_count(file.rows_off, "row") + " left out: use = Off");
  if (!file.left_out.problems.empty()) {
    warnings.push_back(measurements::describe_left_out(file.left_out, "", file.path, "field"));
  }
  std::vector<std::string> unread;
  for (const std::string& column : file.ignored_columns) {
    if (column != "file" && column != "test_date") unread.push_back(column);  // they name the session
  }
  if (!unread.empty()) {
    warnings.push_back(fmt::format("not read, since the form has no such column: {}", fmt::join(unread, ", ")));
  }
  return warnings;
}

}  // namespace rollrig::estimation
