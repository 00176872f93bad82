#pragma once
/// Options that describe a run, shared by run and sweep.

#include <CLI/CLI.hpp>

#include "rollrig/run.h"

namespace rollrig::cli {

void add_run_options(CLI::App& command, RunInput& input);

}  // namespace rollrig::cli
