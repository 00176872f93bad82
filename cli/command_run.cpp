#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/html_option.h"
#include "cli/output_files.h"
#include "cli/print.h"
#include "cli/progress.h"
#include "cli/run_options.h"
#include "measurements/measurement_set.h"
#include "report/run_page.h"
#include "scenarios/common/written_set.h"
#include "sim/core/file_io.h"

namespace rollrig::cli {
namespace {

struct Options {
  RunOptions run;
  std::string out;
  std::string json;
  HtmlOption html;
  std::string set_folder;
  bool force = false;
  bool quiet = false;
};

int run_command(const Options& options) {
  const scenarios::RunSpec spec = scenarios::read_run_spec(options.run.make_document(), options.run.base_folder());
  const scenarios::PreparedRun run = scenarios::prepare_run(spec);
  if (!options.set_folder.empty() && !spec.scenario->set_kind.has_value()) {
    throw InputError({fmt::format("scenario '{}' writes no measurement set", spec.scenario->text.name), "command line",
                      0, "--write-set", options.set_folder,
                      "--out for result and recording; sets come from drum tests, wheel_program and drive", ""});
  }
  if (!options.out.empty() && !options.set_folder.empty() && is_same_place(options.out, options.set_folder)) {
    throw InputError({"results and measurement set go to one folder", "command line", 0, "--write-set",
                      options.set_folder, "another folder than that of --out", ""});
  }
  // Refused before the run, not after it, when the results could not be written.
  std::optional<OutputFolder> out;
  std::optional<OutputFolder> set;
  if (!options.out.empty()) out.emplace(options.out, options.force);
  const OutputFiles files({{"--json", options.json}, {"--html", options.html.path}});
  if (!options.set_folder.empty()) set.emplace(options.set_folder, options.force);
  ProgressLine progress(spec.scenario->text.name, options.quiet);
  const scenarios::Outcome outcome = run(progress.callback());
  const std::string result = scenarios::make_result_json(spec, outcome).dump(2) + "\n";
  files.require_no_input();
  if (out.has_value()) {
    out->add("result.json", result);
    out->add("recording.csv", scenarios::make_recording_csv(outcome.recording));
    out->add("manifest.json", scenarios::make_manifest(spec, outcome).dump(2) + "\n");
    out->commit();
  }
  if (set.has_value()) {
    for (auto& [name, content] : scenarios::write_measurement_set(spec, outcome, spec.scenario->text.name)) {
      set->add(name, content);
    }
    set->commit();
  }
  if (!options.json.empty()) write_output(options.json, result);
  if (options.html.is_wanted()) options.html.write(report::make_run_page(spec, outcome));
  if (options.quiet || options.json == "-" || options.html.is_standard_output()) return kDone;
  std::cout << format_outcome(spec, outcome) << options.html.note();
  if (out.has_value())
    std::cout << fmt::format("  written to {}/: result.json recording.csv manifest.json\n", options.out);
  if (set.has_value()) std::cout << fmt::format("  measurement set written to {}/\n", options.set_folder);
  if (set.has_value() && !spec.sensors.has_value()) {
    std::cout << wrap(
        "warning: nothing is measured in it: --sensors source, dyno or road, or a file, gives it channels", 2);
  }
  return kDone;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Run a scenario on a rig");
  auto options = std::make_shared<Options>();
  options->run.add_to(*command);
  command->add_option("--out", options->out, "Folder for result.json, recording.csv, manifest.json");
  command->add_option("--write-set", options->set_folder, "Folder for the run as a measurement set");
  command->add_option("--json", options->json, "File for result.json, - for standard output");
  options->html.add_to(*command);
  command->add_flag("--force", options->force, "Write into folders that hold files");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return run_command(*options); }; });
}

}  // namespace rollrig::cli
