#include <fmt/format.h>

#include <iostream>
#include <map>

#include "cli/progress.h"
#include "sim/core/text.h"
#include "validation/program/commands.h"
#include "validation/scoring/follow_up.h"

namespace rollrig::validation {
namespace {

struct PlanCommandOptions {
  PlanOrder order;
  bool drawn = false;
  bool quiet = false;
};

/// How many cases leave something open, and why some of them are not followed up.
std::string summarize(const std::vector<FollowUpPlan>& plans, const std::string& folder) {
  std::map<std::string, std::size_t> reasons;
  for (const FollowUpPlan& plan : plans) ++reasons[plan.not_made];
  const std::size_t planned = reasons[""];
  reasons.erase("");
  std::string text =
      wrap(fmt::format("cases with causes that they cannot tell apart: {}; tests for {} of them in {}/plans",
                       plans.size(), planned, folder),
           0);
  for (const auto& [reason, count] : reasons) text += wrap(fmt::format("{} not: {}", count, reason), 2);
  return text;
}

int plan_command(PlanCommandOptions options) {
  cli::require_one_process("rollrig_validation plan");
  PlanOrder& order = options.order;
  if (options.drawn) order.choice = Choice::kDrawn;
  order.answers = place_in(order.set, "answers", order.answers);
  cli::ProgressLine progress("plan", options.quiet);
  order.progress = [&progress](std::size_t done, std::size_t of) {
    progress.update(static_cast<double>(done) / static_cast<double>(of));
  };
  const std::vector<FollowUpPlan> plans = plan_follow_ups(order);
  progress.clear();
  if (!options.quiet) {
    std::cout << summarize(plans, place_in(order.set, folder_of(order.choice)));
  }
  return cli::kDone;
}

}  // namespace

void add_plan_command(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<PlanCommandOptions>(
      app, action, "plan",
      "Write the follow-up test of each case whose causes cannot be told apart, the truth unopened, for follow-up",
      plan_command);
  PlanOrder& order = options->order;
  add_set_to(*command, order.set);
  command->add_option("--answers", order.answers, "Folder of the answers [answers in the validation set]");
  command->add_flag("--drawn", options->drawn, "A test drawn from the menu for each, instead of the proposed one");
  add_seed(*command, order.seed, "Of what is drawn");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::validation
