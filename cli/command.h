#pragma once
/// The parts of the command line.

#include <CLI/CLI.hpp>

#include <functional>

namespace rollrig::cli {

/// Exit statuses of formats.md.
enum ExitStatus { kDone = 0, kDiffers = 1, kInputError = 2, kRunFailed = 3, kInterrupted = 130 };

/// What a subcommand does when it is called; set by the add_ functions below.
using Action = std::function<int()>;

/// Each adds one subcommand with its options to `app` and sets `action` when that subcommand is called.
void add_run_command(CLI::App& app, Action& action);
void add_sweep_command(CLI::App& app, Action& action);
void add_regress_command(CLI::App& app, Action& action);
void add_validate_command(CLI::App& app, Action& action);
void add_list_command(CLI::App& app, Action& action);
void add_convert_command(CLI::App& app, Action& action);
void add_describe_command(CLI::App& app, Action& action);
void add_fit_command(CLI::App& app, Action& action);
/// Below `fit`.
void add_fit_road_load(CLI::App& fit, Action& action);
/// Under `fit`.
void add_fit_drum_coastdown_command(CLI::App& fit, Action& action);
void add_diagnose_command(CLI::App& app, Action& action);
void add_import_command(CLI::App& app, Action& action);
void add_export_command(CLI::App& app, Action& action);
/// make, run, score, plan, baselines and oracle below `blind`.
void add_blind_command(CLI::App& app, Action& action);
void add_completion_command(CLI::App& app, Action& action);
void add_man_command(CLI::App& app, Action& action);

}  // namespace rollrig::cli
