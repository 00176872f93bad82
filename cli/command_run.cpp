#include <fmt/format.h>

#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct RunOptions {
  RunInput run;
  OutputOptions output;
  std::string set_folder;
  UncertaintyOptions uncertainty;
};

/// Throws InputError where the scenario has no report or no uncertainty that was asked for.
void require_asked(const RunOptions& options, const Run& run) {
  if (!options.output.report.empty() && !run.has_test_report()) {
    throw usage_error(fmt::format("there is no test report of scenario '{}'", run.scenario()), "--report",
                      options.output.report,
                      fmt::format("a scenario with one: {}; --html for a page of any scenario",
                                  fmt::join(list_scenarios_with_test_report(), ", ")));
  }
}

int run_command(const RunOptions& options) {
  const Run run(options.run);
  if (!options.set_folder.empty() && !run.writes_set()) {
    throw usage_error(fmt::format("scenario '{}' writes no measurement set", run.scenario()), "--write-set",
                      options.set_folder,
                      "--out for result and recording; sets come from drum tests, follow_roller and follow_road");
  }
  require_asked(options, run);
  UncertaintyOptions uncertainty = options.uncertainty;
  uncertainty.budget_if_any = !options.output.report.empty() && run.has_uncertainty();
  run.check(uncertainty);
  Output output(options.output, {{"--write-set", options.set_folder}});
  std::optional<OutputFolder> set;
  if (!options.set_folder.empty()) set.emplace(options.set_folder, options.output.force);
  const RunResult result = [&] {
    ProgressLine progress(run.scenario(), options.output.quiet);
    return run.carry_out(progress.callback(), uncertainty);
  }();
  const FolderFiles set_files = set.has_value() ? result.make_set_files() : FolderFiles();
  output.stage(result);
  std::string notes;
  if (set.has_value()) {
    output.stage(*set, set_files);
    notes = fmt::format("  measurement set written to {}/\n", options.set_folder);
    if (!run.has_sensors()) {
      notes +=
          wrap("warning: nothing is measured in it: --sensors source, dyno or road, or a file, gives it channels", 2);
    }
  }
  output.finish(result.text, notes);
  return kDone;
}

}  // namespace

void add_run_options(CLI::App& command, RunInput& input) {
  command.add_option("scenario", input.scenario_or_file, "Scenario name, or a run file (.toml)")->required();
  command.add_option("--tire", input.tire, "Name under assets/tires, or a path");
  command.add_option("--rig", input.rig, "Name under assets/rigs, or a path [the scenario's]");
  command.add_option("--vehicle", input.vehicle, "Name under assets/vehicles, or a path [source_car]");
  command.add_option("--fidelity", input.fidelity, "multibody or quasi_static [multibody]");
  command.add_option("--baseline", input.baseline, "combined or constant_rrc [combined]");
  command.add_option("--sensors", input.sensors, "Virtual sensors: a name under assets/sensors, a path, or none");
  command.add_option("--seed", input.seed, "Seed of the sensors' random numbers [1]");
  command
      .add_option("--set", input.settings,
                  "key=value: a setting of the scenario, or tire.<table>.<key>, rig.<table>.<key>, "
                  "vehicle.<table>.<key>, effects.<id>.<parameter>; may be repeated")
      ->expected(1)
      ->take_all();
}

void add_run_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<RunOptions>(app, action, "run", "Run a scenario on a rig", &run_command);
  add_run_options(*command, options->run);
  add_output_option(*command, "--write-set", options->set_folder, "Folder for the run as a measurement set");
  options->output.add_to(*command, "File for result.json, - for standard output",
                         "Folder for result.json, recording.csv, manifest.json");
  options->output.add_report_to(*command);
  add_uncertainty_options(*command, options->uncertainty);
}

}  // namespace rollrig::cli
