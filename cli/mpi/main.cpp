/// rollrig_mpi: `rollrig campaign run FOLDER --mpi`, a program of its own, so that rollrig does not link MPI.
#include <iostream>
#include <memory>
#include <optional>

#include "api/open_campaign.h"
#include "campaigns/mpi/hand_out.h"
#include "cli/command.h"
#include "cli/help_formatter.h"
#include "cli/output_files.h"
#include "cli/progress.h"

namespace rollrig::cli {
namespace {

struct MpiOptions {
  std::string folder;
  bool has_program_progress = false;
  OutputOptions output;
};

/// The items that are done, in the first process, which alone says so.
campaigns::Tally hand_out(const MpiOptions& options, const OpenCampaign& campaign, const campaigns::Ranks& ranks) {
  const std::unique_ptr<CampaignItems> items = campaign.make_watched_items();
  if (!ranks.is_first()) return campaigns::hand_out_items(*items, campaign.folder, ranks, {});
  ProgressLine progress("campaign", options.output.quiet,
                        options.has_program_progress ? ProgressReader::kProgram : ProgressReader::kPerson);
  const auto advance = [&progress](double done) { progress.update(done); };
  const campaigns::Tally tally = campaigns::hand_out_items(*items, campaign.folder, ranks, advance);
  advance(1.0);  // also where there was nothing to do
  return tally;
}

int run_over_mpi(const MpiOptions& options) {
  campaigns::Ranks ranks;
  const OpenCampaign campaign = open_campaign(options.folder);
  std::optional<Output> output;
  if (ranks.is_first()) output.emplace(options.output);
  campaigns::Tally tally;
  try {
    tally = hand_out(options, campaign, ranks);
  } catch (const Interrupted&) {
    ranks.abandon();
    if (ranks.is_first()) std::cerr << "stopped: the finished items are saved; the same command continues\n";
    return kInterrupted;
  }
  if (!ranks.is_first()) return kDone;
  const CampaignState state = make_state(tally, campaign.folder.path);
  output->show(state);
  return state.failed == 0 ? kDone : kRunFailed;
}

int make_and_run(int argc, char** argv) {
  CLI::App app{"Carries out a campaign: the first process of mpirun hands out the items to the others", "rollrig_mpi"};
  app.formatter(std::make_shared<HelpFormatter>());
  auto options = std::make_shared<MpiOptions>();
  app.add_option("folder", options->folder, "Folder of the campaign")->required();
  app.add_flag("--progress", options->has_program_progress, "As rollrig campaign run has it");
  add_output_option(app, "--json", options->output.json, "File for the counts of items, - for standard output");
  app.add_flag("--quiet", options->output.quiet, "Print nothing but errors");
  const Action action = [options] { return run_over_mpi(*options); };
  return parse_and_act(app, action, argc, argv);
}

}  // namespace
}  // namespace rollrig::cli

int main(int argc, char** argv) {
  return rollrig::cli::run_program(argc, argv, &rollrig::cli::make_and_run, &rollrig::campaigns::end_other_processes);
}
