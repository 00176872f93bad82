#pragma once
/// rollrig blind plan.

#include "cli/command.h"

namespace rollrig::cli {

/// Below `blind`.
void add_blind_plan(CLI::App& blind, Action& action);

}  // namespace rollrig::cli
