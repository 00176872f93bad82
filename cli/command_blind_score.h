#pragma once
/// rollrig blind score.

#include "cli/command.h"

namespace rollrig::cli {

constexpr const char* kAloneFolder = "answers-alone";       // answers with the true effect alone in the race
constexpr const char* kLeftOutFolder = "answers-left-out";  // and with it left out

/// Below `blind`.
void add_blind_score(CLI::App& blind, Action& action);

}  // namespace rollrig::cli
