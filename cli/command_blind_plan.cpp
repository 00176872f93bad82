#include "cli/command_blind_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

#include "cli/progress.h"
#include "sim/core/text.h"
#include "validation/scoring/follow_up.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

struct Options {
  proof::PlanOrder order;
  bool drawn = false;
  bool quiet = false;
};

/// How many sets leave something open, and why some of them are not followed up.
std::string summarize(const std::vector<proof::FollowUpPlan>& plans, const std::string& folder) {
  std::map<std::string, std::size_t> reasons;
  std::size_t planned = 0;
  for (const proof::FollowUpPlan& plan : plans) {
    if (plan.not_made.empty()) {
      ++planned;
    } else {
      ++reasons[plan.not_made];
    }
  }
  std::string text =
      wrap(fmt::format("sets with causes that they cannot tell apart: {}; tests for {} of them in {}/plans",
                       plans.size(), planned, folder),
           0);
  for (const auto& [reason, count] : reasons) text += wrap(fmt::format("{} not: {}", count, reason), 2);
  return text;
}

int plan_command(Options options) {
  proof::PlanOrder& order = options.order;
  if (options.drawn) order.choice = proof::Choice::kDrawn;
  if (order.answers.empty()) order.answers = (fs::path(order.bank) / "answers").string();
  ProgressLine progress("plan", options.quiet);
  order.progress = [&progress](std::size_t done, std::size_t of) {
    progress.update(static_cast<double>(done) / static_cast<double>(of));
  };
  const std::vector<proof::FollowUpPlan> plans = proof::plan_follow_ups(order);
  if (!options.quiet) {
    std::cout << summarize(plans, (fs::path(order.bank) / proof::folder_of(order.choice)).string());
  }
  return kDone;
}

}  // namespace

void add_blind_plan(CLI::App& blind, Action& action) {
  CLI::App* command = blind.add_subcommand(
      "plan",
      "Write the next test of each set whose causes cannot be told apart, the truth unopened, for rollrig_blind "
      "followup");
  auto options = std::make_shared<Options>();
  command->add_option("bank", options->order.bank, "Folder made by rollrig blind make")->required();
  command->add_option("--answers", options->order.answers, "Folder of the answers [answers in the bank]");
  command->add_flag("--drawn", options->drawn, "A test drawn from the menu for each, instead of the proposed one");
  command->add_option("--seed", options->order.seed, "Of what is drawn [1]");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return plan_command(*options); }; });
}

}  // namespace rollrig::cli
