#include <fmt/format.h>

#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "diagnosis/checks/set_checks.h"
#include "measurements/logs/import.h"
#include "measurements/measurement_set.h"
#include "sim/core/error_text.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct Options {
  std::string mapping;
  std::string data;
  std::string out;
  std::string json;
  bool force = false;
  bool quiet = false;
};

std::string format_clock(const measurements::ClockEstimate& clock) {
  const char* how = clock.method == "common"     ? "from what both logs measure"
                    : clock.method == "response" ? "from how the tire answers to speed and load"
                                                 : "as the mapping gives it";
  std::string text = wrap(fmt::format("clock of {} against {}:", clock.tire_log, clock.torque_log), 2);
  text += fmt::format("    shift {:+.3f} +- {:.3f} s (1 sd), {}\n", clock.clock.shift_s, clock.calc_shift_sd_s(), how);
  text += fmt::format("    rate  {:+.1f} +- {:.1f} ppm{}\n", 1e6 * clock.clock.rate, 1e6 * clock.rate_sd,
                      clock.rate_is_decided ? "" : ", not decided by the logs");
  for (const measurements::ClockEvidence& evidence : clock.evidence) {
    text += fmt::format("    {:<24} {:>7} rows, {:5.1f} % of it follows the torque log\n", evidence.channel.header(),
                        evidence.rows, 100.0 * evidence.explained);
  }
  return text;
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
  for (const std::string& warning : imported.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

/// What rollrig validate says of the set: a column that was taken over without its unit shows there.
std::string format_checks(const std::string& folder) {
  std::string text;
  try {
    for (const std::string& warning : diagnosis::check_set(measurements::read_measurement_set(folder)).warnings) {
      text += wrap("warning: " + warning, 2);
    }
  } catch (const InputError& error) {
    text = "  " + format_error("warning: ", error.problem());
  } catch (const RunFailure& failure) {
    text = wrap(fmt::format("warning: {}", failure.what()), 2);
  } catch (const Interrupted&) {  // the set is written, whole
    text = "  warning: not checked to the end\n";
  }
  return text;
}

int import_command(const Options& options) {
  const measurements::Mapping mapping = measurements::read_mapping(options.mapping, options.data);
  OutputFolder out(options.out, options.force);
  const OutputFiles files({{"--json", options.json}});
  const measurements::Import imported = measurements::import_logs(mapping);
  files.require_no_input();
  for (auto& [name, content] : measurements::make_set_files(mapping, imported)) out.add(name, content);
  out.commit();
  if (!options.json.empty()) write_output(options.json, to_text(measurements::make_import_json(mapping, imported)));
  if (options.quiet || options.json == "-") return kDone;
  std::cout << format_import(mapping, imported);
  std::cout << format_checks(options.out)
            << fmt::format("  written to {}/: set.toml, a CSV a run, import.json, marks.csv\n", options.out);
  return kDone;
}

}  // namespace

void add_import_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<Options>(
      app, action, "import", "Join a torque log and a tire log, each on its own clock, into a measurement set",
      &import_command);
  command->add_option("mapping", options->mapping, "Mapping file (.toml): columns, units, time stamps, runs")
      ->required();
  command->add_option("--data", options->data, "Folder of the logs [that of the mapping]");
  command->add_option("--out", options->out, "Folder for the set")->required();
  command->add_option("--json", options->json, "File for the report, - for standard output");
  command->add_flag("--force", options->force, "Write into a folder that holds files");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::cli
