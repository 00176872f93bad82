#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/label.h"

namespace rollrig::cli {
namespace {

struct LabelOptions {
  LabelInput input;
  OutputOptions output;
};

int label_command(const LabelOptions& options) {
  Output output(options.output);
  output.show(make_label(options.input));
  return kDone;
}

}  // namespace

void add_label_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<LabelOptions>(
      app, action, "label", "Class of the EU label by rolling resistance, and limits of type approval", &label_command);
  LabelInput& input = options->input;
  command->add_option("--rrc", input.rrc_N_per_kN, "RRc of ISO 28580 in N/kN, which is kg/t");
  command->add_option("--rrc-sd", input.rrc_sd_N_per_kN,
                      "Its standard uncertainty in N/kN [0.075, class C3 0.06: the limit of sigma_m]");
  command->add_option("--class", input.tire_class, "Class C1, C2 or C3 [that of the tire]");
  command->add_option("--load-index", input.load_index, "Load index, such as 91 or 91V; checked against the class");
  command->add_option("--speed-symbol", input.speed_symbol, "Speed symbol, such as V; checked against the class");
  command->add_flag("--severe-snow", input.is_severe_snow, "For severe snow conditions: limits 1 N/kN higher");
  command->add_option("--tire", input.tire, "Name under assets/tires, or a path; without --rrc its test is simulated");
  add_output_option(*command, "--json", options->output.json, "File for the result, - for standard output");
}

}  // namespace rollrig::cli
