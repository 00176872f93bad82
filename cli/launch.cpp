// Several processes of one command, which does not share its work.
#include <fmt/format.h>

#include <iostream>
#include <string>

#include "cli/command.h"
#include "cli/message.h"
#include "rollrig/item_campaign.h"

namespace rollrig::cli {

void require_one_process(const std::string& command, const std::string& instead, bool quiet) {
  const std::optional<CampaignPart> launched = find_launched_part();
  if (launched.has_value() && launched->count > 1) {
    throw usage_error(fmt::format("{} processes were started, and each would do all of the work", launched->count),
                      command, "", "one process" + (instead.empty() ? "" : "; to share the work, " + instead));
  }
  if (quiet || instead.empty() || !is_array_task()) return;
  std::cerr << wrap_message(
      fmt::format("warning: this is a task of a job array. {} does all of its work in each task; to "
                  "share it, {}",
                  command, instead));
}

}  // namespace rollrig::cli
