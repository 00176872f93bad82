#include <fmt/format.h>

#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/measurement_set.h"
#include "rollrig/scaffold.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"

namespace rollrig::cli {
namespace {

struct ImportOptions {
  std::string mapping;
  GuessOptions guess;
  std::string data;
  BadRows bad_rows = BadRows::kRefuse;
  OutputOptions output;
};

/// What rollrig validate says of the set: a column that was taken over without its unit shows there.
std::string format_checks(const std::string& folder) {
  ProgressLine progress("import", false);
  try {
    return format_warnings(check_file(folder, BadRows::kRefuse, progress.callback()).warnings);
  } catch (const InputError& error) {
    return "  " + format_error("warning: ", error.problem());
  } catch (const RunFailure& failure) {
    return format_warnings({failure.what()});
  } catch (const Interrupted&) {  // the set is written, whole
    return format_warnings({"not checked to the end"});
  }
}

/// By the mapping, or by what is guessed of a folder.
Report read_and_import(const ImportOptions& options) {
  const bool is_guess = !options.guess.folder.empty();
  if (is_guess == !options.mapping.empty()) {
    throw usage_error(is_guess ? "a mapping and --guess do not go together" : "no mapping is given", "mapping",
                      options.mapping, "a mapping file (.toml), or --guess FOLDER");
  }
  ProgressLine progress("import", options.output.quiet);
  return is_guess ? import_guessed(options.guess, options.output.folder, options.bad_rows, progress.callback())
                  : import_logs(options.mapping, options.data, options.bad_rows, progress.callback());
}

int import_command(const ImportOptions& options) {
  Output output(options.output);
  const Report imported = read_and_import(options);
  output.stage(imported);
  output.commit(imported.text);
  if (options.output.is_silent()) return kDone;
  std::cout << format_checks(options.output.folder)
            << fmt::format("  written to {}/: set.toml, one CSV for each run, import.json, marks.csv\n",
                           options.output.folder);
  return kDone;
}

}  // namespace

void add_import_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ImportOptions>(
      app, action, "import", "Join a torque log and a tire log, each on its own clock, into a measurement set",
      &import_command);
  command->add_option("mapping", options->mapping, "Mapping file (.toml): columns, units, time stamps, runs");
  command->add_option("--guess", options->guess.folder,
                      "Guess the mapping from this folder of logs; further options help");
  command->add_option("--data", options->data, "Folder of the logs [that of the mapping]");
  add_output_option(*command, "--out", options->output.folder, "Folder for the set")->required();
  add_skip_bad_rows(*command, options->bad_rows);
  add_output_option(*command, "--json", options->output.json, "File for the report, - for standard output");
  command->add_flag("--force", options->output.force, "Write into a folder that holds files");
  command->add_flag("--quiet", options->output.quiet, "Print nothing but errors");
  add_guess_set_options(*command, options->guess);
}

}  // namespace rollrig::cli
