#include "validation/generator/follow_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "validation/generator/laboratory.h"
#include "validation/generator/opened_truth.h"
#include "validation/generator/output.h"
#include "validation/generator/planned_runs.h"
#include "validation/generator/problem.h"
#include "validation/generator/workers.h"

namespace fs = std::filesystem;

namespace blind {
namespace {

/// Sets that have a plan, sorted.
std::vector<std::string> list_plans(const FollowUpOrder& order) {
  const fs::path folder = fs::path(follow_up_folder(order)) / "plans";
  std::vector<std::string> sets;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) sets.push_back(entry.path().filename().string());
  }
  if (sets.empty()) {
    throw InputError({fmt::format("no plans in '{}'", folder.string()), "bank", order.bank,
                      fmt::format("first: rollrig blind plan {}{}", order.bank, order.drawn ? " --drawn" : ""), ""});
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

Files follow_up_set(const FollowUpOrder& order, const std::string& set, const nlohmann::ordered_json& truth) {
  const fs::path plan_folder = fs::path(follow_up_folder(order)) / "plans" / set;
  const SetOrder made_by = read_order(truth);
  require_same_files((fs::path(order.bank) / "sets" / set).string(), made_by);
  const Laboratory lab = draw_laboratory(made_by);
  TestPlan plan = read_test_plan(plan_folder.string(), made_by, lab.campaign.runs.front().legs.front().load_N);
  const std::string sha256 = hash_files(make_set(made_by, false).files);
  if (plan.set_sha256 != sha256) {
    throw InputError({fmt::format("'{}' is a plan for other files", (plan_folder / "plan.json").string()), "set_sha256",
                      plan.set_sha256, sha256, ""});
  }
  for (const RunPlan& run : plan.runs) {
    const bool is_taken = std::any_of(lab.campaign.runs.begin(), lab.campaign.runs.end(),
                                      [&](const RunPlan& own) { return own.id == run.id; });
    if (!is_taken) continue;
    throw InputError({fmt::format("'{}': the set has this run already", (plan_folder / "plan.json").string()), "id",
                      run.id, "names of new runs", ""});
  }
  return follow_up(made_by, std::move(plan.runs));
}

}  // namespace

std::string follow_up_folder(const FollowUpOrder& order) {
  return (fs::path(order.bank) / (order.drawn ? "followup-drawn" : "followup")).string();
}

std::size_t write_follow_up(const FollowUpOrder& order, const std::function<void(std::size_t, std::size_t)>& progress) {
  const OpenedTruth truth = open_truth(order.bank);
  const std::vector<std::string> sets = list_plans(order);
  for (const std::string& set : sets) {
    if (truth.sets.contains(set)) continue;
    throw InputError({fmt::format("'{}/plans' has a plan for a set that the bank has not", follow_up_folder(order)),
                      "plans", set, "the sets of " + order.bank, ""});
  }
  StagedFolder folder((fs::path(follow_up_folder(order)) / "sets").string(), "bank");
  std::vector<Files> made(sets.size());
  work_on_all(
      sets.size(), order.threads,
      [&](std::size_t i) { made[i] = follow_up_set(order, sets[i], truth.sets.at(sets[i])); }, progress);
  for (std::size_t i = 0; i < sets.size(); ++i) folder.write(sets[i], made[i]);
  folder.commit();
  return sets.size();
}

}  // namespace blind
