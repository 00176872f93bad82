// Each log as a run of the set: when it began, how warm and how inflated the tire was.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <boost/date_time/gregorian/gregorian.hpp>

#include "measurements/logs/guess.h"
#include "measurements/logs/time_stamps.h"
#include "sim/core/error.h"

namespace fs = std::filesystem;

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;

constexpr double kAsTheAir_K = 3.0;            // Assumed: a tire that is nearer to the air than this has soaked
constexpr double kLongestRest_s = 8 * 3600.0;  // Assumed: after it, nothing remembers the run before

const GuessedColumn* find_column_for(const std::vector<GuessedColumn>& columns, const Quantity& target) {
  const auto at = std::find_if(columns.begin(), columns.end(),
                               [&target](const GuessedColumn& column) { return column.target == target; });
  return at == columns.end() ? nullptr : &*at;
}

/// Mean of the first values of a column, in the unit of the set; none where the log has no values.
std::optional<double> find_first_value(const GuessSource& source, const GuessedLog& log, const GuessedColumn& column) {
  constexpr int kFirst = 5;  // Assumed: rows in which the tire hardly warms
  if (column.value.has_value()) return column.value;
  double sum = 0.0;
  int count = 0;
  for (const std::string& cell : log.cells_of(column.heading)) {
    const std::optional<double> number = parse_log_number(cell, source.form.csv.decimal);
    if (!number.has_value()) continue;
    sum += column.unit.convert(column.sign * *number, column.target);
    if (++count == kFirst) break;
  }
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

std::string make_run_id(const std::string& path) {
  std::string id = fs::path(path).stem().string();
  for (char& c : id) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (!is_plain && c != '_') c = '_';
  }
  return id;
}

std::string name_day(double time_s) {
  const auto days = static_cast<long>(std::floor(time_s / kDay_s));
  return boost::gregorian::to_iso_extended_string(boost::gregorian::date(1970, 1, 1) + boost::gregorian::days(days));
}

void find_start_of_tire(const GuessSource& source, const GuessedLog& log, const std::vector<GuessedColumn>& columns,
                        GuessedRun& run) {
  const GuessedColumn* liner = find_column_for(columns, quantities::kLinerTemperature);
  const GuessedColumn* pressure = find_column_for(columns, quantities::kCavityPressure);
  const GuessedColumn& air = *find_column_for(columns, quantities::kAmbient);
  std::optional<double> tire_degC = liner == nullptr ? std::nullopt : find_first_value(source, log, *liner);
  run.reason =
      tire_degC.has_value() ? "first liner temperatures" : "first temperatures of the air: no liner temperature";
  if (!tire_degC.has_value()) tire_degC = find_first_value(source, log, air);
  if (!tire_degC.has_value()) {
    throw source.problem(fmt::format("'{}' has no value of {}", log.path, air.target.header()), "--value", "",
                         fmt::format("--value {}=NUMBER", air.target.header()));
  }
  run.initial_tire_temperature_K = *tire_degC + kZeroCelsius_K;
  std::optional<double> pressure_kPa = source.options.cold_pressure_kPa;
  if (pressure_kPa.has_value()) {
    run.reason += "; pressure as --cold-pressure says";
  } else {
    if (pressure != nullptr) pressure_kPa = find_first_value(source, log, *pressure);
    run.reason += "; first pressures";
  }
  if (!pressure_kPa.has_value()) {
    throw source.problem("no column tells the pressure of the cold tire", "--cold-pressure", "",
                         "--cold-pressure NUMBER, in kPa, gauge");
  }
  run.cold_pressure_Pa = 100.0 * std::round(10.0 * *pressure_kPa);
}

/// How much warmer than the air the tire was at first.
double find_excess_K(const GuessSource& source, const GuessedLog& log, const std::vector<GuessedColumn>& columns,
                     const GuessedRun& run) {
  const GuessedColumn& air = *find_column_for(columns, quantities::kAmbient);
  const std::optional<double> air_degC = find_first_value(source, log, air);
  return air_degC.has_value() ? run.initial_tire_temperature_K - kZeroCelsius_K - *air_degC : 0.0;
}

void find_rest(const GuessSource& source, const GuessedTime& time, const GuessedRun* before, double excess_K,
               GuessedRun& run) {
  const auto given = source.options.rests_min.find(run.id);
  const double gap_s = before == nullptr ? kLongestRest_s : run.start_s - before->end_s;
  if (given != source.options.rests_min.end()) {
    run.rest_before_s = 60.0 * given->second;
    run.reason += "; rest as --rest says";
  } else if (time.is_dated && before != nullptr && gap_s < kLongestRest_s) {
    if (gap_s < 0.0) {
      throw source.problem(fmt::format("run '{}' begins before '{}' has ended", run.id, before->id), "", run.path,
                           "logs one after the other");
    }
    run.rest_before_s = 6.0 * std::round(gap_s / 6.0);
    run.reason += fmt::format("; rest since '{}' by the clock", before->id);
  } else if (excess_K < kAsTheAir_K) {
    run.reason += "; soaked, since the tire was as warm as the air";
  } else {
    throw source.problem(
        fmt::format("run '{}' began with a tire {:.1f} K warmer than the air, and the logs do not tell how long it had "
                    "stood since the run before",
                    run.id, excess_K),
        "--rest", run.path, fmt::format("--rest {}=MINUTES; 0 right after another run", run.id));
  }
}

/// Takes the offset of the liner's sensor off the temperature at the start. A tire that has soaked is as warm as the
/// air, which shows the offset; in the same session it is the same.
void correct_start_of_tire(double excess_K, std::map<std::string, double>& offsets_K, GuessedRun& run) {
  constexpr double kLargestOffset_K = 1.5;  // Assumed
  if (!run.rest_before_s.has_value() && std::abs(excess_K) < kLargestOffset_K) {
    offsets_K.emplace(run.session, excess_K);
    run.initial_tire_temperature_K -= excess_K;
    run.reason +=
        fmt::format("; a soaked tire is as warm as the air, and the liner's sensor reads {:+.1f} K", excess_K);
    return;
  }
  const auto offset_K = offsets_K.find(run.session);
  if (offset_K == offsets_K.end()) return;
  run.initial_tire_temperature_K -= offset_K->second;
  run.reason += fmt::format("; less the {:+.1f} K of the soaked run of the session", offset_K->second);
}

void require_known_rests(const GuessSource& source, const std::vector<GuessedRun>& runs) {
  std::vector<std::string> ids;
  for (const GuessedRun& run : runs) ids.push_back(run.id);
  for (const auto& [id, rest_min] : source.options.rests_min) {
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) continue;
    InputProblem problem = unknown_name("run", id, ids);
    problem.file = "command line";
    problem.key = "--rest";
    throw InputError(problem);
  }
}

}  // namespace

std::vector<GuessedRun> guess_runs(const GuessSource& source, const GuessedTime& time,
                                   const std::vector<GuessedColumn>& columns) {
  std::vector<std::pair<GuessedRun, const GuessedLog*>> found;
  for (const GuessedLog& log : source.logs) {
    GuessedRun run;
    run.id = make_run_id(log.path);
    run.path = log.path;
    const std::vector<double> times_s = read_guessed_times(source, time, log);
    run.start_s = times_s.front();
    run.end_s = times_s.back();
    run.session = time.is_dated ? name_day(run.start_s) : "session-1";
    find_start_of_tire(source, log, columns, run);
    found.emplace_back(std::move(run), &log);
  }
  if (time.is_dated) {
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first.start_s < b.first.start_s; });
  }
  std::vector<GuessedRun> runs;
  std::map<std::string, double> offsets_K;  // of the liner's sensor, by session
  for (auto& [run, log] : found) {
    const double excess_K = find_excess_K(source, *log, columns, run);
    find_rest(source, time, runs.empty() ? nullptr : &runs.back(), excess_K, run);
    correct_start_of_tire(excess_K, offsets_K, run);
    run.reason += time.is_dated ? "; session: the day" : "; one session, since the logs state no day";
    runs.push_back(std::move(run));
  }
  require_known_rests(source, runs);
  return runs;
}

}  // namespace rollrig::measurements
