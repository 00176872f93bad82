#include "proof/oracle.h"

#include <algorithm>

namespace rollrig::proof {

std::vector<Task> plan_oracle(const std::vector<Truth>& truths, OracleRace race, const std::vector<std::string>& only) {
  std::vector<Task> tasks;
  for (const Truth& truth : truths) {
    if (truth.effects.empty() || truth.outside) continue;
    const std::vector<std::string> ids = truth.ids();
    if (race == OracleRace::kAlone) {
      tasks.push_back({truth.set, ids, {}});
      continue;
    }
    Task task{truth.set, only, ids};
    for (const std::string& id : ids)
      task.only.erase(std::remove(task.only.begin(), task.only.end(), id), task.only.end());
    tasks.push_back(std::move(task));
  }
  return tasks;
}

}  // namespace rollrig::proof
