#pragma once
/// The commands of rollrig_validation. Words that commands and options once had stay accepted, and are not shown.

#include <cstdint>
#include <string>

#include "cli/command.h"

namespace rollrig::validation {

/// make, make-case, list, upper-bound and follow-up: what the generator does.
void add_generator_commands(CLI::App& app, cli::Action& action);
/// run, baselines and known-cause: what answers cases.
void add_answer_commands(CLI::App& app, cli::Action& action);
void add_plan_command(CLI::App& app, cli::Action& action);
/// Loops of tests, the generator as the rig.
void add_loop_command(CLI::App& app, cli::Action& action);
/// make-pairs, run-pairs and score-pairs: two machines that test the same tire.
void add_pair_commands(CLI::App& app, cli::Action& action);
/// Where the effects change the readings, for the score.
void add_locations_command(CLI::App& app, cli::Action& action);
void add_score_command(CLI::App& app, cli::Action& action);
void add_release_check_command(CLI::App& app, cli::Action& action);

constexpr const char* kAloneFolder = "answers-alone";       // in a validation set: the true effect alone
constexpr const char* kLeftOutFolder = "answers-left-out";  // likewise: without it

/// The validation set that a command is for.
void add_set_to(CLI::App& command, std::string& set);

/// --seed, a whole number. `seed` has the default, `what` says what it decides.
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& what);

/// A place in a validation set, unless another is given.
std::string place_in(const std::string& set, const std::string& name, const std::string& given = {});

}  // namespace rollrig::validation
