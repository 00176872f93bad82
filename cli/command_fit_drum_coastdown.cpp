#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/fit.h"

namespace rollrig::cli {
namespace {

struct Options {
  std::string set;
  std::string data;
  OutputOptions output;
};

int fit_drum_coastdown_command(const Options& options) {
  Output output(options.output);
  const Report fit = fit_drum_coastdown(options.set, options.data);
  output.write(fit);
  output.print(fit.text);
  return kDone;
}

}  // namespace

void add_fit_drum_coastdown_command(CLI::App& fit, Action& action) {
  const auto [command, options] = add_command<Options>(
      fit, action, "drum-coastdown", "Rolling resistance from coast-downs of a drum, tire loaded and lifted",
      &fit_drum_coastdown_command);
  command->add_option("set", options->set, "Set of coast-downs (.toml)")->required();
  command->add_option("--data", options->data, "Folder of the set's CSV files [that of the set]");
  options->output.add_to(*command, "File for fit.json, - for standard output",
                         "Folder for fit.json, decelerations.csv, residuals.csv");
}

}  // namespace rollrig::cli
