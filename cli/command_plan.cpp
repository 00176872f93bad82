#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/plan.h"

namespace rollrig::cli {
namespace {

struct PlanOptions {
  CampaignInput campaign;
  ComparisonOptions effects;
  OutputOptions output;
};

int plan_command(const PlanOptions& options) {
  CampaignInput input = options.campaign;
  input.only = options.effects.only;
  input.without = options.effects.without;
  Output output(options.output);
  const Campaign campaign = [&] {
    ProgressLine progress("plan", options.output.quiet);
    input.progress = progress.callback();
    return plan_campaign(input);
  }();
  output.show(campaign);
  return kDone;
}

}  // namespace

void add_plan_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<PlanOptions>(
      app, action, "plan", "Which tests of a machine make most effects visible within so many hours", &plan_command);
  CampaignInput& input = options->campaign;
  command->add_option("--rig", input.rig, "drum, flat_belt, dyno or road; or a rig under assets/rigs or a path")
      ->capture_default_str();
  command->add_option("--hours", input.hours, "Hours of the machine at most: set-up, soaks and runs")
      ->capture_default_str();
  command->add_option("--tire", input.tire, "Tire under assets/tires or a path")->capture_default_str();
  command->add_option("--vehicle", input.vehicle, "Vehicle under assets/vehicles or a path; of the road")
      ->capture_default_str();
  command->add_option("--sensors", input.sensors, "Sensors under assets/sensors or a path [those of the machine]");
  options->effects.add_to(*command);
  options->output.add_to(*command, "File for the plan, - for standard output",
                         "Folder for run files, plan.txt and a set.toml to be filled");
  add_threads(*command, input.threads);
}

}  // namespace rollrig::cli
