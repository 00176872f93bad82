// Several processes of one command, which does not share its work.
#include <fmt/format.h>

#include <iostream>

#include "cli/command.h"
#include "rollrig/item_campaign.h"
#include "sim/core/text.h"

namespace rollrig::cli {

void require_one_process(const std::string& command, const std::string& instead, bool quiet) {
  const std::optional<CampaignPart> launched = find_launched_part();
  if (launched.has_value() && launched->count > 1) {
    throw usage_error(fmt::format("{} processes were started, and each would do all of the work", launched->count),
                      "rollrig " + command, "", fmt::format("one process; to share the work, {}", instead));
  }
  if (quiet) return;
  const std::optional<CampaignPart> task = find_campaign_part();
  if (!task.has_value() || task->count == 1) return;
  std::cerr << wrap(
                   fmt::format("warning: this is task {} of {} of a job array. rollrig {} does all of its work in each "
                               "task; to share it, {}",
                               task->number, task->count, command, instead),
                   2)
                   .substr(2);
}

}  // namespace rollrig::cli
