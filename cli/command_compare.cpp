#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/compare.h"

namespace rollrig::cli {
namespace {

struct CompareOptions {
  CompareInput input;
  OutputOptions output;
};

int compare_command(const CompareOptions& options) {
  Output output(options.output);
  const Comparison comparison = [&] {
    ProgressLine progress("compare", options.output.quiet);
    return compare(options.input, progress.callback());
  }();
  output.show(comparison);
  return kDone;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<CompareOptions>(
      app, action, "compare", "Compare results, measurement sets or tires with the first of them", &compare_command);
  command
      ->add_option("compared", options->input.compared,
                   "Two or more of one kind: folders of run --out, measurement sets, or tires (names or files)")
      ->required();
  command->add_option("--scenario", options->input.scenario,
                      "Of tires: a virtual test beside that of ISO 28580 [none]");
  add_threads(*command, options->input.threads);
  add_skip_bad_rows(*command, options->input.bad_rows);
  options->output.add_to(*command, "File for the comparison, - for standard output",
                         "Folder for comparison.json, differences.csv");
}

}  // namespace rollrig::cli
