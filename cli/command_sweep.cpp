#include <fmt/format.h>

#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/sweep.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct SweepOptions {
  SweepInput sweep;
  std::vector<std::string> vary;
  OutputOptions output;
};

int sweep_command(const SweepOptions& options) {
  SweepInput input = options.sweep;
  for (const std::string& text : options.vary) input.axes.push_back(read_sweep_axis(text));
  const Sweep sweep(input);
  Output output(options.output);
  SweepResult result;
  {  // its line is gone before the results are printed
    ProgressLine progress("sweep", options.output.quiet);
    result = sweep.carry_out(progress.callback());
  }
  output.show(result);
  const std::size_t failed = result.count_failures();
  if (failed == 0) return kDone;
  std::cout << std::flush;
  std::cerr << wrap(fmt::format("run failed: {} of {} points of the sweep; the others are as they should be", failed,
                                result.points.size()),
                    2)
                   .substr(2);
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
  command
      ->add_option("--show", options->sweep.shown,
                   "Results in the terminal's table, with commas [the first that change]")
      ->delimiter(',');
  add_threads(*command, options->sweep.threads);
  options->output.add_to(*command, "File for the results, - for standard output",
                         "Folder for sweep.csv, sweep.json, manifests/");
}

}  // namespace rollrig::cli
