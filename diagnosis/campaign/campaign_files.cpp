#include "diagnosis/campaign/campaign_files.h"

#include <fmt/format.h>

#include "diagnosis/next_test/next_test.h"
#include "diagnosis/next_test/plan_files.h"
#include "sim/core/text.h"

namespace rollrig::diagnosis {
namespace {

std::string write_campaign_text(const PlannedCampaign& campaign, const std::vector<ProposedTest>& tests) {
  const bool is_road = !campaign.set.kind->names_rig();
  std::string text = fmt::format("Campaign on {} with tire {}: {:.1f} h of {}\n\n", name_machine(campaign.set),
                                 campaign.set.tire.name, campaign.hours, is_road ? "the vehicle" : "the rig");
  text += wrap(fmt::format("{} of {} effects would be visible at their usual size. A visible effect may still be taken "
                           "for another one; rollrig diagnose then says which test tells them apart.",
                           count_visible(campaign), campaign.effects.size()),
               2);
  std::size_t before = 0;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const CampaignTest& entry = campaign.ledger[i];
    text += fmt::format("\nTest {}, {:.1f} h with set-up{}, done after {:.1f} h\n\n", i + 1, entry.hours,
                        entry.is_soaked ? " and soaks" : "", entry.hours_until_end);
    text += wrap(entry.test, 2);
    text += entry.shows.empty() ? "" : wrap(fmt::format("Makes visible: {}", fmt::join(entry.shows, ", ")), 2);
    text += "\n" + describe_runs(tests[i], before, *campaign.set.kind);
    before += tests[i].runs.size();
  }
  text += "On paper first: what the simulation without any effect expects, as a set\n\n";
  for (std::size_t n = 1; n <= before; ++n) {
    text += fmt::format("  rollrig run run-{0}.toml --write-set set-{0}\n", n);
  }
  return text + "\n  With --set effects.<id>.<parameter>=... the same with an effect on.\n\nAfterwards\n\n" +
         wrap(
             "set.toml has a [[run]] for each run. Put the measured files beside it, correct temperatures, pressures "
             "and sensors to what they were, then: rollrig validate . and rollrig diagnose .",
             2);
}

}  // namespace

std::map<std::string, std::string> write_campaign(const PlannedCampaign& campaign) {
  std::vector<ProposedTest> tests;
  for (std::size_t i = 0; i < campaign.tests.size(); ++i) {
    tests.push_back(make_proposed_test(campaign.tests[i]));
    // Sensors were zeroed before each test.
    for (measurements::MeasuredRun& run : tests.back().runs) {
      run.session = fmt::format("test {}{}", i + 1, run.session.substr(std::string("next").size()));
    }
  }
  std::map<std::string, std::string> files = write_test_files(campaign.set, tests);
  files["set.toml"] = write_set_to_fill(campaign.set, tests);
  files["plan.txt"] = write_campaign_text(campaign, tests);
  return files;
}

}  // namespace rollrig::diagnosis
