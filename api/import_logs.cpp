#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "api/data.h"
#include "measurements/logs/import.h"
#include "sim/core/columns.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

std::string format_clock(const measurements::ClockEstimate& clock) {
  const char* how = clock.method == "common"     ? "from what both logs measure"
                    : clock.method == "response" ? "from how the tire answers to speed and load"
                                                 : "as the mapping gives it";
  std::string text = wrap(fmt::format("clock of {} against {}:", clock.tire_log, clock.torque_log), 2);
  text += fmt::format("    shift {:+.3f} +- {:.3f} s (1 sd), {}\n", clock.clock.shift_s, clock.calc_shift_sd_s(), how);
  text += fmt::format("    rate  {:+.1f} +- {:.1f} ppm{}\n", 1e6 * clock.clock.rate, 1e6 * clock.rate_sd,
                      clock.rate_is_decided ? "" : ", not decided by the logs");
  Table table{"", {"channel", "rows", "follows the torque log, %"}, {}};
  for (const measurements::ClockEvidence& evidence : clock.evidence) {
    table.rows.push_back(
        {evidence.channel.header(), std::to_string(evidence.rows), fmt::format("{:.1f}", 100.0 * evidence.explained)});
  }
  return table.rows.empty() ? text : text + format_table(table, 4);
}

std::string format_run(const measurements::ImportedRun& run) {
  constexpr std::size_t kMost = 8;  // import.json has all
  std::string text = fmt::format("  run {}: {}\n", run.plan.id, format_count(run.rows.time_s.size(), "row"));
  for (std::size_t i = 0; i < std::min(kMost, run.rows.empty.size()); ++i) {
    const measurements::EmptyRange& range = run.rows.empty[i];
    text += wrap(fmt::format("{} {} from {:.6g} to {:.6g} s ({}): {}", range.column.header(),
                             range.rows_left_out ? "missing, rows left out" : "empty", range.from_s, range.to_s,
                             format_count(range.rows, "row"), range.reason),
                 4);
  }
  if (run.rows.empty.size() > kMost) text += fmt::format("    and {} more\n", run.rows.empty.size() - kMost);
  return text;
}

std::string format_import(const measurements::Mapping& mapping, const measurements::Import& imported) {
  std::string text = fmt::format("import   set {}   {}\n", mapping.set.name, format_count(imported.runs.size(), "run"));
  for (const measurements::ClockEstimate& clock : imported.clocks) text += format_clock(clock);
  for (const measurements::ImportedRun& run : imported.runs) text += format_run(run);
  for (const measurements::Log& log : imported.logs) {
    std::map<std::string, std::size_t> counts;
    for (const measurements::Mark& mark : log.marks) ++counts[mark.reason];
    for (const auto& [reason, count] : counts) text += fmt::format("  {}: {} x {}\n", log.file, count, reason);
  }
  return text + format_warnings(imported.warnings);
}

}  // namespace

Report import_logs(const std::string& mapping_file, const std::string& data, BadRows bad_rows,
                   const Progress& progress) {
  return import_by_mapping(measurements::read_mapping(mapping_file, data), bad_rows, progress);
}

Report import_by_mapping(const measurements::Mapping& mapping, BadRows bad_rows, const Progress& progress) {
  const auto imported =
      std::make_shared<const measurements::Import>(measurements::import_logs(mapping, bad_rows, progress));
  Report report;
  report.text = format_import(mapping, *imported);
  report.json = to_text(measurements::make_import_json(mapping, *imported));
  report.make_files = [mapping, imported] { return to_folder(measurements::make_set_files(mapping, *imported)); };
  return report;
}

}  // namespace rollrig
