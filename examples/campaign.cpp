/// Spread of a tire's rolling resistance from the uncertainty of its numbers. Usage: campaign <folder> <tire>
#include <rollrig/rollrig.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace {

namespace fs = std::filesystem;

void define(const std::string& folder, const std::string& tire) {
  rollrig::RunCampaignInput input;
  input.run.scenario_or_file = "iso_28580";
  input.run.tire = tire;
  input.run.fidelity = "quasi_static";
  input.run.seed = "1";
  input.drawn_sd = {"tire"};  // each number of the tire file that has an _sd
  input.points = 50;
  rollrig::define_run_campaign(input, folder);
}

/// Carries out the items that are not done yet. If the program is stopped, the next call continues.
int carry_out(const std::string& folder) {
  const rollrig::ItemCampaign campaign(folder);
  // In a job array of Slurm or under mpirun, each process does its part.
  const rollrig::CampaignPart part = rollrig::find_campaign_part().value_or(rollrig::CampaignPart{});
  const rollrig::CampaignState state = campaign.carry_out(part);
  std::printf("%zu of %zu items done, %zu failed\n", state.done, state.items, state.failed);
  if (part.count > 1) return 0;  // a call without part, after all parts, writes the table
  std::ofstream table(fs::path(folder) / "spread.csv");
  campaign.write_csv([&table](const std::string& rows) { table << rows; });
  return table.flush() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: campaign <folder> <tire>\n", stderr);
    return 2;
  }
  try {
    if (!fs::exists(fs::path(argv[1]) / "campaign.json")) define(argv[1], argv[2]);
    return carry_out(argv[1]);
  } catch (const rollrig::InputError& error) {  // an unknown tire; a file that has changed since the campaign was begun
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
