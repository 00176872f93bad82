#include "validation/generator/follow_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "validation/files.h"
#include "validation/generator/known_order.h"
#include "validation/generator/laboratory.h"
#include "validation/generator/planned_runs.h"

namespace fs = std::filesystem;

namespace rollrig::generator {
namespace {

/// Cases that have a plan, sorted.
std::vector<std::string> list_plans(const FollowUpOrder& order) {
  const fs::path folder = fs::path(follow_up_folder(order)) / "plans";
  std::vector<std::string> numbers;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) numbers.push_back(entry.path().filename().string());
  }
  if (numbers.empty()) {
    throw InputError({fmt::format("no plans in '{}'", folder.string()), order.set, 0, "", "",
                      fmt::format("first: rollrig_validation plan {}{}", order.set, order.drawn ? " --drawn" : ""),
                      ""});
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

Files follow_up_case(const FollowUpOrder& order, const std::string& number, const Json& truth) {
  const std::string plan_folder = (fs::path(follow_up_folder(order)) / "plans" / number).string();
  const std::string plan_file = plan_folder + "/plan.json";
  const SetOrder made_by = read_order(truth);
  const std::string folder = validation::case_folder(order.set, number);
  require_same_files(folder, made_by);
  const Laboratory lab = draw_laboratory(made_by);
  TestPlan plan = read_test_plan(plan_folder, made_by, lab.campaign.runs.front().legs.front().load_N);
  if (plan.set_sha256 != validation::hash_case(folder)) {
    throw InputError(
        {"a plan for other files", plan_file, 0, "set_sha256", plan.set_sha256, validation::hash_case(folder), ""});
  }
  for (const RunPlan& run : plan.runs) {
    const bool is_taken = std::any_of(lab.campaign.runs.begin(), lab.campaign.runs.end(),
                                      [&](const RunPlan& own) { return own.id == run.id; });
    if (is_taken)
      throw InputError({"the case has this run already", plan_file, 0, "id", run.id, "names of new runs", ""});
  }
  return follow_up(made_by, std::move(plan.runs));
}

}  // namespace

std::string follow_up_folder(const FollowUpOrder& order) {
  return (fs::path(order.set) / (order.drawn ? validation::kDrawnFollowUpFolder : validation::kFollowUpFolder))
      .string();
}

std::size_t write_follow_up(const FollowUpOrder& order, const Progress& progress) {
  const Json truths = validation::open_truth(order.set, "").cases;
  const std::vector<std::string> numbers = list_plans(order);
  for (const std::string& number : numbers) {
    if (truths.contains(number)) continue;
    throw InputError({"a plan for a case that the validation set has not", follow_up_folder(order) + "/plans", 0, "",
                      number, "the cases of " + order.set, ""});
  }
  const std::string out = follow_up_folder(order) + "/sets";
  validation::require_new_folder(out, "followup");
  OutputFolder folder(out, true);
  std::vector<Files> made(numbers.size());
  work_on_all(numbers.size(), order.threads, progress,
              [&](std::size_t i) { made[i] = follow_up_case(order, numbers[i], truths.at(numbers[i])); });
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (auto& [file, content] : made[i]) folder.add(numbers[i] + "/" + file, std::move(content));
  }
  folder.commit();
  return numbers.size();
}

}  // namespace rollrig::generator
