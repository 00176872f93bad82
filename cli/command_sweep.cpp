#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/message.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/sweep.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

struct SweepOptions {
  SweepInput sweep;
  std::vector<std::string> vary;
  OutputOptions output;
};

/// "out.unfinished" for "out" and "out/", also where the folder is the working folder. Empty where the folder beside
/// cannot be made.
std::string place_unfinished(const std::string& out) {
  fs::path place = fs::path(out).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();  // "out/"
  if (place.filename() == "." || place.filename() == "..") place = fs::weakly_canonical(fs::absolute(place));
  place += ".unfinished";
  const fs::path parent = place.has_parent_path() ? place.parent_path() : fs::path(".");
  const bool is_refused = fs::exists(parent) && ::access(parent.c_str(), W_OK) != 0;
  return is_refused ? std::string() : place.string();
}

int sweep_command(const SweepOptions& options) {
  require_one_process("rollrig sweep", "rollrig campaign new and run", options.output.quiet);
  SweepInput input = options.sweep;
  for (const std::string& text : options.vary) input.axes.push_back(read_sweep_axis(text));
  if (!options.output.folder.empty()) {
    input.unfinished_folder = place_unfinished(options.output.folder);
    if (input.unfinished_folder.empty() && !options.output.quiet) {
      std::cerr << wrap_message(
          fmt::format("warning: if the sweep is interrupted, its results are lost, since the folder of {} "
                      "cannot be written to",
                      options.output.folder));
    }
  }
  const Sweep sweep(input);
  Output output(options.output);
  SweepResult result;
  try {
    ProgressLine progress("sweep", options.output.quiet);
    result = sweep.carry_out(progress.callback());
  } catch (const Interrupted&) {
    if (input.unfinished_folder.empty()) throw;
    std::cerr << wrap_message(fmt::format("stopped: the finished points are saved in {}; the same command continues",
                                          input.unfinished_folder));
    return kInterrupted;
  }
  output.show(result);
  sweep.remove_unfinished();
  const std::size_t failed = result.count_failures();
  if (failed == 0) return kDone;
  std::cout << std::flush;
  std::cerr << wrap_message(fmt::format("run failed: {} of {} points of the sweep; the other points are complete",
                                        failed, result.points.size()));
  return kRunFailed;
}

}  // namespace

void add_sweep_command(CLI::App& app, Action& action) {
  const auto [command, options] =
      add_command<SweepOptions>(app, action, "sweep", "Run a scenario at every point of a grid", &sweep_command);
  add_run_options(*command, options->sweep.run);
  command->add_option("--vary", options->vary, "key=a,b,c or key=from:to:step; may be repeated")
      ->required()
      ->expected(1)
      ->take_all();
  split_names(command->add_option("--show", options->sweep.shown,
                                  "Results in the terminal's table, with commas [the first that change]"));
  add_threads(*command, options->sweep.threads);
  options->output.add_to(*command, "File for the results, - for standard output",
                         "Folder for sweep.csv, sweep.json, manifests.json");
}

}  // namespace rollrig::cli
