#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "cli/command.h"
#include "cli/message.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/measurement_set.h"
#include "sim/core/error.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct ValidateOptions {
  std::vector<std::string> paths;
  BadRows bad_rows = BadRows::kRefuse;
};

/// A folder of sets stands for these.
std::vector<std::string> list_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    const std::vector<std::string> sets = find_sets(path);
    if (!sets.empty()) warn_of_undescribed(path);
    files.insert(files.end(), sets.begin(), sets.end());
    if (sets.empty()) files.push_back(path);
  }
  return files;
}

/// What a CI job asks: 2 where a file is wrong, 1 where a set cannot be what it is said to be, as of a regression that
/// differs. A set that is merely warned of is good.
int validate_command(const ValidateOptions& options) {
  int status = kDone;
  const std::vector<std::string> paths = list_files(options.paths);
  ProgressLine line("validate", false);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    throw_if_interrupted();
    const std::string& path = paths[i];
    const auto report = [&](double share, const std::string& stage) {
      line.update((static_cast<double>(i) + share) / static_cast<double>(paths.size()), stage);
    };
    try {
      const FileCheck found = check_file(path, options.bad_rows, report);
      line.clear();
      std::cout << wrap_message(fmt::format("{}: {} {}", path, found.is_good ? "good" : "doubtful", found.what));
      for (const std::string& warning : found.warnings) std::cout << wrap(warning, 2);
      if (!found.is_good) status = std::max<int>(status, kDiffers);
    } catch (const InputError& error) {  // of one file: the others are checked as well
      line.clear();
      std::cout << std::flush;
      std::cerr << format_error("error: ", error.problem());
      status = kInputError;
    }
  }
  return status;
}

}  // namespace

void add_validate_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ValidateOptions>(
      app, action, "validate",
      "Check files; of a measurement set also whether columns and units can be right: exit status 1 where they cannot",
      &validate_command);
  command
      ->add_option("file", options->paths,
                   "Tire, rig, run, sensors, vehicle or set.toml, a set's folder or one with such folders, or a "
                   "cycle's CSV")
      ->required();
  add_skip_bad_rows(*command, options->bad_rows);
}

}  // namespace rollrig::cli
