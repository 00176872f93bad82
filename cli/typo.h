#pragma once
/// Usage errors with the nearest known name.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "sim/core/error.h"

namespace rollrig::cli {

/// CLI11's message, and the nearest option or subcommand when a word was not expected.
InputProblem explain_usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

/// Long option names of an app, such as "--tire"; here as below without what is hidden.
std::vector<std::string> list_options(const CLI::App& app);
/// A subcommand by name or alias, or nullptr.
const CLI::App* find_subcommand(const CLI::App& app, const std::string& name);
/// Names of its subcommands.
std::vector<std::string> list_subcommands(const CLI::App& app);

}  // namespace rollrig::cli
