#pragma once
/// The parts of the command line, and what all programs of the project share: reading options, answering errors, exit
/// statuses.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <boost/algorithm/string/trim.hpp>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rollrig/bad_rows.h"
#include "rollrig/run.h"
#include "rollrig/scaffold_options.h"
#include "sim/core/error.h"

namespace rollrig::cli {

/// Exit statuses of formats.md.
enum ExitStatus { kDone = 0, kDiffers = 1, kInputError = 2, kRunFailed = 3, kInternalError = 70, kInterrupted = 130 };

/// What a subcommand does when it is called; set by the add_..._command functions below.
using Action = std::function<int()>;

/// What main() of a program does: calls `make_and_run`, which makes its command line and runs it. Returns the exit
/// status; errors go to standard error. `end_others` is called with a status that is not kDone.
int run_program(int argc, char** argv, int (*make_and_run)(int argc, char** argv),
                void (*end_others)(int status) = nullptr);

/// Reads the command line and does what its subcommand has set in `action`.
int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv);

/// A subcommand that calls `run` with its options, which are the caller's to declare.
template <class Options, class Run>
std::pair<CLI::App*, std::shared_ptr<Options>> add_command(CLI::App& parent, Action& action, const std::string& name,
                                                           const std::string& doc, Run run) {
  CLI::App* command = parent.add_subcommand(name, doc);
  auto options = std::make_shared<Options>();
  command->callback([options, run, &action] { action = [options, run] { return run(*options); }; });
  return {command, options};
}

/// A mistake on the command line.
inline InputError usage_error(const std::string& what, const std::string& option, const std::string& value,
                              const std::string& allowed) {
  return InputError({what, "command line", 0, option, value, allowed, ""});
}

/// As CLI::Range, which lets NaN pass.
template <class Number>
CLI::Validator in_range(Number lowest, Number highest) {
  CLI::Validator range = CLI::Range(lowest, highest);
  return range.operation([range, lowest, highest](std::string& text) {
    Number value{};
    const bool is_between = CLI::detail::lexical_cast(text, value) && lowest <= value && value <= highest;
    return is_between ? std::string() : fmt::format("Value {} not in range {} to {}", text, lowest, highest);
  });
}

/// What --help shows of limits that the library checks, for C++ and Python too.
template <class Number>
CLI::Validator shown_range(Number lowest, Number highest) {
  CLI::Validator range = CLI::Range(lowest, highest);
  return range.operation([](std::string&) { return std::string(); });
}

/// CLI11's message, and the nearest option or subcommand when a word was not expected.
InputProblem explain_usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

/// Long option names of an app, such as "--tire". Hidden ones are left out, here and in list_subcommands().
std::vector<std::string> list_options(const CLI::App& app);
/// A subcommand by name or alias, or nullptr.
const CLI::App* find_subcommand(const CLI::App& app, const std::string& name);
/// Names of its subcommands.
std::vector<std::string> list_subcommands(const CLI::App& app);

/// --threads; 0, as where it is not given: as many as the machine has, as in the library.
inline void add_threads(CLI::App& command, int& threads,
                        const std::string& doc = "Threads; 0 for as many as the machine has [0]") {
  command.add_option("--threads", threads, doc)->check(in_range(0, 1024));
}

/// For a command that does not share its work: throws InputError where mpirun or srun has started several processes,
/// each of which would do all of it. `command` begins with the name of the program. `instead` says how the work can be
/// shared, and is empty where it cannot; otherwise, a task of a job array is warned, unless `quiet`: other tasks may do
/// the same.
void require_one_process(const std::string& command, const std::string& instead = "", bool quiet = false);

/// Spaces about the names of a list with commas: "a, b".
inline CLI::Option* split_names(CLI::Option* option) {
  return option->delimiter(',')->transform([](const std::string& name) { return boost::algorithm::trim_copy(name); });
}

/// --uncertainty, --monte-carlo, --threads and, where the command has no seed of another meaning, --seed.
inline void add_uncertainty_options(CLI::App& command, UncertaintyOptions& options, bool with_seed = false) {
  command.add_flag("--uncertainty", options.budget, "Uncertainty budget of the results (GUM)");
  command.add_option("--monte-carlo", options.monte_carlo_trials,
                     "Number of trials of the Monte Carlo method beside the budget (GUM Supplement 1) [none]");
  if (with_seed) {
    constexpr std::int64_t kMostSeed = 9007199254740991;  // as that of a run: 2^53 - 1
    command.add_option("--seed", options.seed, "Seed of the Monte Carlo trials [1]")
        ->check(in_range(std::int64_t{0}, kMostSeed));
  }
  add_threads(command, options.threads);
}

/// --smallest-effect.
CLI::Option* add_smallest_effect(CLI::App& command, double& percent);

/// --skip-bad-rows.
inline void add_skip_bad_rows(CLI::App& command, BadRows& bad_rows) {
  command.add_flag_callback(
      "--skip-bad-rows", [&bad_rows] { bad_rows = BadRows::kLeaveOut; },
      "Leave out rows that cannot be used, at most 5 % of a file, and tell which");
}

/// --only and --without: which effects are in the comparison, shared by diagnose and validation.
struct ComparisonOptions {
  std::vector<std::string> only;
  std::vector<std::string> without;

  void add_to(CLI::App& command);
  /// Throws InputError: an effect that does not exist, with the nearest; one that is asked for and left out.
  void check() const;
};

/// Each adds one subcommand with its options to `app` and sets `action` when that subcommand is called.
void add_run_command(CLI::App& app, Action& action);
void add_sweep_command(CLI::App& app, Action& action);
void add_campaign_command(CLI::App& app, Action& action);
void add_regress_command(CLI::App& app, Action& action);
void add_validate_command(CLI::App& app, Action& action);
void add_list_command(CLI::App& app, Action& action);
/// What `list` takes: scenarios, effects and the folders of assets.
std::vector<std::string> list_kinds();
void add_align_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_convert_command(CLI::App& app, Action& action);
void add_label_command(CLI::App& app, Action& action);
void add_describe_command(CLI::App& app, Action& action);
void add_fit_command(CLI::App& app, Action& action);
/// Options that describe a run, of run and sweep.
void add_run_options(CLI::App& command, RunInput& input);
/// Below `fit`.
void add_fit_road_load(CLI::App& fit, Action& action);
void add_fit_rolling_laws(CLI::App& fit, Action& action);
void add_fit_default_road_load(CLI::App& fit, Action& action);
void add_diagnose_command(CLI::App& app, Action& action);
void add_plan_command(CLI::App& app, Action& action);
void add_serve_command(CLI::App& app, Action& action);
void add_import_command(CLI::App& app, Action& action);
void add_new_command(CLI::App& app, Action& action);
/// What a user says of logs beside the files; the second also what a set of them needs.
void add_guess_options(CLI::App& command, GuessOptions& options);
void add_guess_set_options(CLI::App& command, GuessOptions& options);
void add_export_command(CLI::App& app, Action& action);
void add_completion_command(CLI::App& app, Action& action);
void add_man_command(CLI::App& app, Action& action);

}  // namespace rollrig::cli
