#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/message.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/regress.h"

namespace rollrig::cli {
namespace {

struct RegressOptions {
  std::string folder;
  OutputOptions output;
  int threads = 0;
  bool update = false;
};

int find_status(const std::vector<RegressedRun>& runs) {
  int status = kDone;
  for (const RegressedRun& run : runs) {
    if (run.status == "same" || run.status == "updated") continue;
    status = std::max<int>(status, run.status.rfind("bad", 0) == 0 ? kInputError : kDiffers);
  }
  return status;
}

/// On standard error, what the table would say.
void tell_problems(const Regression& found) {
  for (const RegressedRun& run : found.runs) {
    if (run.problems.empty() || run.status == "updated") continue;
    std::cerr << wrap_message(fmt::format("error: {}: {}: {}",
                                          (std::filesystem::path(found.folder) / run.name).string(), run.status,
                                          run.problems.front()));
    if (run.problems.size() > 1) std::cerr << fmt::format("  and {} more\n", run.problems.size() - 1);
  }
}

int regress_command(const RegressOptions& options) {
  require_one_process("rollrig regress", "a folder of run files for each process", options.output.quiet);
  Output output(options.output);
  Regression found = [&] {
    ProgressLine progress("regress", options.output.quiet);
    return regress(options.folder, {options.threads, progress.callback()});
  }();
  output.require_no_input();
  if (options.update) found = update_goldens(found);
  output.show(found);
  if (options.output.is_silent()) tell_problems(found);
  return find_status(found.runs);
}

}  // namespace

void add_regress_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<RegressOptions>(
      app, action, "regress", "Rerun all regression scenarios against their goldens", &regress_command);
  command->add_option("folder", options->folder, "Folder of run files [assets/regression]")
      ->check([](const std::string& folder) { return folder.empty() ? "the name of a folder is empty" : ""; });
  command->add_flag("--update", options->update, "Write goldens that differ, are missing or cannot be read");
  add_threads(*command, options->threads);
  options->output.add_to(*command, "File for the comparison, - for standard output");
}

}  // namespace rollrig::cli
