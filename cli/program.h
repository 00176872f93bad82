#pragma once
/// What all programs of the project have in common: options read, errors answered, exit statuses.

#include <CLI/CLI.hpp>

#include <functional>

#include "cli/command.h"

namespace rollrig::cli {

/// Calls what makes a program's command line and runs it. Returns the exit status; errors go to standard error.
int run_program(const std::function<int()>& body);

/// Reads the command line and does what its subcommand has set in `action`.
int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv);

}  // namespace rollrig::cli
