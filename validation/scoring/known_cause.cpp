// Fits that know the cause, made once the truth is open.
#include <algorithm>

#include "models/effect.h"
#include "validation/scoring/follow_up.h"
#include "validation/scoring/run_cases.h"
#include "validation/scoring/truth.h"

namespace rollrig::validation {

Twins find_twins(const std::vector<Truth>& truths, const std::string& answers) {
  Twins twins;
  for (const Truth& truth : truths) {
    const std::optional<Answer> answer = find_answer(answers, truth.number);
    if (!answer || !answer->failure.empty()) continue;
    std::vector<std::string> named = list_named(answer->diagnosis);
    if (!truth.is_within(named)) continue;
    for (const std::string& id : truth.ids()) named.erase(std::remove(named.begin(), named.end(), id), named.end());
    if (!named.empty()) twins[truth.number] = named;
  }
  return twins;
}

void add_confusable(const std::vector<Truth>& truths, Twins& twins) {
  const auto holds = [](const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  for (const Truth& truth : truths) {
    if (truth.outside) continue;
    const std::vector<std::string> ids = truth.ids();
    for (const models::Effect* effect : models::all_effects()) {
      const models::EffectInfo& info = effect->info;
      const bool is_confusable = std::any_of(ids.begin(), ids.end(), [&](const std::string& id) {
        return holds(info.confused_with, id) || holds(models::find_effect(id).info.confused_with, info.id);
      });
      if (!is_confusable || holds(ids, info.id)) continue;
      std::vector<std::string>& of_case = twins[truth.number];
      if (!holds(of_case, info.id)) of_case.push_back(info.id);
    }
  }
}

std::vector<Task> plan_known_cause(const std::vector<Truth>& truths, KnownCause cause,
                                   const std::vector<std::string>& only, const Twins& twins) {
  std::vector<Task> tasks;
  for (const Truth& truth : truths) {
    if (truth.effects.empty() || truth.outside) continue;
    const std::vector<std::string> ids = truth.ids();
    if (cause == KnownCause::kAlone) {
      tasks.push_back({truth.number, ids, {}});
      continue;
    }
    Task task{truth.number, only, ids};
    const auto of_case = twins.find(truth.number);
    if (of_case != twins.end()) task.without.insert(task.without.end(), of_case->second.begin(), of_case->second.end());
    for (const std::string& id : task.without) {
      task.only.erase(std::remove(task.only.begin(), task.only.end(), id), task.only.end());
    }
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace rollrig::validation
