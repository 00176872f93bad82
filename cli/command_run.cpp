#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "measurements/measurement_set.h"
#include "report/run_page.h"
#include "scenarios/common/written_set.h"

namespace rollrig::cli {
namespace {

struct Options {
  RunOptions run;
  OutputOptions output;
  std::string set_folder;
};

int run_command(const Options& options) {
  const scenarios::RunSpec spec = scenarios::read_run_spec(options.run.make_document(), options.run.base_folder());
  const scenarios::PreparedRun run = scenarios::prepare_run(spec);
  if (!options.set_folder.empty() && !spec.scenario->writes_sets) {
    throw InputError({fmt::format("scenario '{}' writes no measurement set", spec.scenario->text.name), "command line",
                      0, "--write-set", options.set_folder,
                      "--out for result and recording; sets come from drum tests, follow_roller and follow_road", ""});
  }
  if (!options.output.folder.empty() && !options.set_folder.empty() &&
      is_same_place(options.output.folder, options.set_folder)) {
    throw usage_error("results and measurement set go to one folder", "--write-set", options.set_folder,
                      "another folder than that of --out");
  }
  Output output(options.output);
  std::optional<OutputFolder> set;
  if (!options.set_folder.empty()) set.emplace(options.set_folder, options.output.force);
  const scenarios::Outcome outcome = [&] {
    ProgressLine progress(spec.scenario->text.name, options.output.quiet);
    return run(progress.callback());
  }();
  const std::string result = to_text(scenarios::make_result_json(spec, outcome));
  output.write({{"result.json", result},
                {"recording.csv", scenarios::make_recording_csv(outcome.recording)},
                {"manifest.json", to_text(scenarios::make_manifest(spec, outcome))}},
               result, [&] { return report::make_run_page(spec, outcome); });
  if (set.has_value()) {
    for (auto& [name, content] : scenarios::write_measurement_set(spec, outcome, spec.scenario->text.name)) {
      set->add(name, content);
    }
    set->commit();
  }
  output.print(format_outcome(spec, outcome));
  if (!set.has_value() || options.output.is_silent()) return kDone;
  std::cout << fmt::format("  measurement set written to {}/\n", options.set_folder);
  if (!spec.sensors.has_value()) {
    std::cout << wrap(
        "warning: nothing is measured in it: --sensors source, dyno or road, or a file, gives it channels", 2);
  }
  return kDone;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<Options>(app, action, "run", "Run a scenario on a rig", &run_command);
  options->run.add_to(*command);
  command->add_option("--write-set", options->set_folder, "Folder for the run as a measurement set");
  options->output.add_to(*command, "File for result.json, - for standard output",
                         "Folder for result.json, recording.csv, manifest.json");
}

}  // namespace rollrig::cli
