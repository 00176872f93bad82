#include <fmt/format.h>

#include <iostream>

#include "sim/core/file_io.h"
#include "sim/core/text.h"
#include "validation/program/commands.h"
#include "validation/scoring/decision_settings.h"

namespace rollrig::validation {
namespace {

struct ReleaseCheckOptions {
  std::string record;
  bool write = false;
};

int release_check_command(const ReleaseCheckOptions& options) {
  const Json now = list_decision_settings();
  if (options.write) {
    write_output(options.record, to_text(now, 1));
    return cli::kDone;
  }
  const SettingsComparison comparison = compare_settings(read_settings(options.record), now);
  std::string text = fmt::format("Thresholds, priors and errors of laws beside {}\n", options.record);
  for (const std::string& id : comparison.new_effects) {
    text += wrap("effect " + id + " is new, which asks for no new validation set", 2);
  }
  for (const std::string& change : comparison.changes) text += wrap(change, 2);
  text += comparison.changes.empty()
              ? "No new validation set is needed: what was there then is as it was.\n"
              : wrap(
                    "A new validation set is needed: the published results are of other settings (docs/validation.md, "
                    "\"A new validation set\").",
                    0);
  std::cout << text;
  return comparison.changes.empty() ? cli::kDone : cli::kDiffers;
}

}  // namespace

void add_release_check_command(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<ReleaseCheckOptions>(
      app, action, "release-check",
      "Compare what decides a diagnosis with what it was when a validation set was answered", release_check_command);
  command->add_option("record", options->record, "File with the settings of that validation set")->required();
  command->add_flag("--write", options->write, "Write the settings of this program to that file instead");
}

}  // namespace rollrig::validation
