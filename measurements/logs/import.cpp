#include "measurements/logs/import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "measurements/spikes.h"
#include "measurements/whitener.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"

namespace rollrig::measurements {
namespace {

/// Marks and takes out the spikes of all columns. Columns that carry inertia (torque, forces) are judged only where
/// the log's speed and load are steady.
void take_out_spikes(Log& log, const models::SensorSet& sensors, double threshold) {
  constexpr double kFloor = 0.1;  // Assumed: of given columns, in m/s, K or m
  const std::vector<bool> steady = find_steady_rows(log.columns, log.time_s.size());
  const std::vector<bool> all(log.time_s.size(), true);
  for (auto& [quantity, values] : log.columns) {
    const auto sensor = sensors.find(quantity);
    double floor = kFloor;
    if (sensor != sensors.end()) floor = std::max(sensor->second.noise_sd, sensor->second.resolution);
    // Loads and forces jump as they are told to.
    if (quantity == models::quantities::kLoad || quantity == models::quantities::kLongitudinalForce) continue;
    const std::vector<bool>& judged = carries_inertia(quantity) ? steady : all;
    for (const std::size_t row : find_spikes(values, threshold, floor, judged)) {
      log.marks.push_back({log.file, log.line[row], quantity, log.time_s[row], log.time_s[row],
                           quantity.file_unit().from_si(values[row]), "spike"});
      values[row] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

std::size_t find_log(const LogForm& form, const std::string& path, const Import& imported) {
  const auto is_it = [&](const Log& log) { return log.file == path && log.form == form.name; };
  return static_cast<std::size_t>(std::find_if(imported.logs.begin(), imported.logs.end(), is_it) -
                                  imported.logs.begin());
}

/// A log that a run needs.
struct NeededLog {
  const LogForm* form = nullptr;
  std::string path;
  double bytes = 0.0;
};

/// Each log once, in the order of the runs.
std::vector<NeededLog> list_needed_logs(const Mapping& mapping) {
  std::vector<NeededLog> needed;
  const auto add = [&needed](const LogForm& form, const std::string& path) {
    const auto is_it = [&](const NeededLog& log) { return log.path == path && log.form->name == form.name; };
    if (std::any_of(needed.begin(), needed.end(), is_it)) return;
    std::error_code code;  // read_log() says what is wrong with the file
    const std::uintmax_t bytes = std::filesystem::file_size(path, code);
    needed.push_back({&form, path, code ? 0.0 : static_cast<double>(bytes)});
  };
  for (const RunPlan& plan : mapping.runs) {
    add(mapping.torque_log, plan.torque_log);
    if (!plan.tire_log.empty()) add(*mapping.tire_log, plan.tire_log);
  }
  return needed;
}

/// Refuses bad rows of logs, or too many of them.
void settle_log_rows(const Import& imported, const RowProblems& problems, BadRows bad_rows, const std::string& hint) {
  if (problems.empty()) return;
  if (bad_rows == BadRows::kRefuse) {
    throw make_rows_error(format_count(count_rows(problems), "bad row") + " in the logs", problems,
                          "with --skip-bad-rows, bad rows are left out", hint);
  }
  constexpr double kMostBad = 0.05;  // Assumed: as in a set
  for (const Log& log : imported.logs) {
    RowProblems of_log;
    std::copy_if(problems.begin(), problems.end(), std::back_inserter(of_log),
                 [&log](const InputProblem& problem) { return problem.file == log.file; });
    const double share = static_cast<double>(count_rows(of_log)) / static_cast<double>(log.time_s.size());
    if (count_rows(of_log) <= 1 || share <= kMostBad) continue;
    throw make_rows_error(fmt::format("{} of {} rows of {} are bad: too many to leave them out", count_rows(of_log),
                                      log.time_s.size(), log.file),
                          of_log, fmt::format("bad rows: at most {:.0f} % of a log", 100.0 * kMostBad), hint);
  }
}

/// Reads each log once. `progress` gets the share of their bytes.
void read_logs(const Mapping& mapping, BadRows bad_rows, const Progress& progress, Import& imported) {
  RowProblems problems;
  const std::vector<NeededLog> needed = list_needed_logs(mapping);
  double all_bytes = 0.0, read_bytes = 0.0;
  for (const NeededLog& log : needed) all_bytes += log.bytes;
  for (const NeededLog& log : needed) {
    const auto report = [&](double share) {
      if (progress && all_bytes > 0.0) progress((read_bytes + share * log.bytes) / all_bytes, "reading logs");
    };
    imported.logs.push_back(read_log(*log.form, log.path, &problems, report));
    read_bytes += log.bytes;
  }
  settle_log_rows(imported, problems, bad_rows, mapping.torque_log.csv.hint);
  for (Log& log : imported.logs) {
    throw_if_interrupted();
    take_out_spikes(log, mapping.set.sensors, mapping.spike_threshold);
  }
}

std::size_t find_or_estimate(const Log& torque_log, const Log& tire_log, const Mapping& mapping, Import& imported) {
  for (std::size_t i = 0; i < imported.clocks.size(); ++i) {
    const ClockEstimate& clock = imported.clocks[i];
    if (clock.torque_log == torque_log.file && clock.tire_log == tire_log.file) return i;
  }
  imported.clocks.push_back(estimate_clock(torque_log, tire_log, mapping));
  return imported.clocks.size() - 1;
}

/// A tire log with the times of its rows and marks on the torque log's clock.
Log put_on_clock(Log log, const Clock& clock) {
  for (double& time_s : log.time_s) time_s = clock.to_torque(time_s);
  for (Mark& mark : log.marks) {
    mark.from_s = clock.to_torque(mark.from_s);
    mark.to_s = clock.to_torque(mark.to_s);
  }
  log.interval_s *= 1.0 + clock.rate;
  return log;
}

void import_run(const RunPlan& plan, const Mapping& mapping, Import& imported) {
  ImportedRun run{plan, {}, std::nullopt};
  const std::size_t torque_at = find_log(mapping.torque_log, plan.torque_log, imported);
  std::optional<Log> on_clock;
  if (!plan.tire_log.empty()) {
    const std::size_t tire_at = find_log(*mapping.tire_log, plan.tire_log, imported);
    run.clock = find_or_estimate(imported.logs[torque_at], imported.logs[tire_at], mapping, imported);
    on_clock = put_on_clock(imported.logs[tire_at], imported.clocks[*run.clock].clock);
  }
  const Log& torque = imported.logs[torque_at];
  const auto read_time = [&](const std::string& text, const char* key, double fallback_s) {
    return text.empty() ? fallback_s : parse_log_time(mapping.torque_log, torque, text, key, plan.origin);
  };
  const double from_s = read_time(plan.from, "from", torque.time_s.front());
  const double to_s = read_time(plan.to, "to", torque.time_s.back());
  const double interval_s = mapping.interval_s.value_or(torque.interval_s);
  run.rows = resample_run(mapping, {&torque, on_clock.has_value() ? &*on_clock : nullptr}, interval_s, from_s, to_s);
  imported.runs.push_back(std::move(run));
}

/// Rows are means over samples of the logs: their noise is the smaller, in all runs taken as in the noisiest.
void average_sensors(const Mapping& mapping, Import& imported) {
  constexpr double kSeveral = 1.5;  // samples a row; below, a row is a sample
  for (const ImportedRun& run : imported.runs) {
    for (const auto& [channel, samples] : run.rows.samples_a_row) {
      const models::SensorParameters& one = mapping.set.sensors.at(channel);
      const models::SensorParameters averaged = samples < kSeveral ? one : average_sensor(one, samples);
      const auto [known, is_new] = imported.sensors.emplace(channel, averaged);
      if (!is_new && averaged.noise_sd > known->second.noise_sd) known->second = averaged;
    }
  }
}

void add_warnings(Import& imported) {
  constexpr double kManySpikes = 0.01;  // Assumed: of a log's rows
  for (const Log& log : imported.logs) {
    std::map<Quantity, std::size_t> spikes;
    for (const Mark& mark : log.marks) spikes[mark.column] += mark.reason == "spike" ? 1 : 0;
    for (const auto& [column, count] : spikes) {
      if (static_cast<double>(count) < kManySpikes * static_cast<double>(log.time_s.size())) continue;
      imported.warnings.push_back(fmt::format("{} of {} rows of '{}' in {} are spikes: more than a sensor at ease has",
                                              count, log.time_s.size(), column.header(), log.file));
    }
  }
  for (const ClockEstimate& clock : imported.clocks) {
    if (clock.method == "response") {
      imported.warnings.push_back(
          fmt::format("the shift of {} rests on how the tire's temperature answers to speed and load; a tire that "
                      "answers late looks like a clock that does (+-{:.3g} s of the uncertainty)",
                      clock.tire_log, clock.lag_sd_s));
    } else if (clock.method == "given") {
      imported.warnings.push_back(
          fmt::format("the shift of {} is the mapping's own; the logs do not tell it better", clock.tire_log));
    }
  }
  for (const ImportedRun& run : imported.runs) {
    for (const auto& [column, values] : run.rows.columns) {
      if (std::any_of(values.begin(), values.end(), [](double value) { return !std::isnan(value); })) continue;
      imported.warnings.push_back(fmt::format("run '{}' has not one value of '{}'", run.plan.id, column.header()));
    }
  }
}

}  // namespace

Import import_logs(const Mapping& mapping, BadRows bad_rows, const Progress& progress) {
  constexpr double kReading = 0.8;  // Assumed: share of the time, as measured with logs of 100 MB
  Import imported;
  const auto report_reading = [&progress](double share, const std::string& stage) {
    if (progress) progress(kReading * share, stage);
  };
  read_logs(mapping, bad_rows, report_reading, imported);
  for (std::size_t i = 0; i < mapping.runs.size(); ++i) {
    throw_if_interrupted();
    const double share = static_cast<double>(i) / static_cast<double>(mapping.runs.size());
    if (progress) progress(kReading + (1.0 - kReading) * share, "joining runs");
    import_run(mapping.runs[i], mapping, imported);
  }
  average_sensors(mapping, imported);
  add_warnings(imported);
  return imported;
}

}  // namespace rollrig::measurements
