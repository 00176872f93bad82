/// rollrig_validation: how well the diagnosis does on cases with a known hidden cause.
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>

#include "campaigns/mpi/ranks.h"
#include "cli/help_formatter.h"
#include "validation/program/commands.h"

namespace rollrig::validation {

void add_set_to(CLI::App& command, std::string& set) {
  command.add_option("set", set, "Folder made by rollrig_validation make")->required();
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& what) {
  const auto set = [&seed](const std::string& text) {
    std::uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || rest != end) {  // CLI11 would take -1 for the largest number
      throw cli::usage_error(fmt::format("'{}' is no seed", text), "--seed", text,
                             fmt::format("a whole number from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
    }
    seed = number;
  };
  command.add_option_function<std::string>("--seed", set, fmt::format("{} [{}]", what, seed));
}

std::string place_in(const std::string& set, const std::string& name, const std::string& given) {
  return given.empty() ? (std::filesystem::path(set) / name).string() : given;
}

namespace {

int make_and_run(int argc, char** argv) {
  CLI::App app{"rollrig_validation: how well the diagnosis does on cases with a known hidden cause",
               "rollrig_validation"};
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.require_subcommand(1);
  cli::Action action;
  add_generator_commands(app, action);
  add_answer_commands(app, action);
  add_plan_command(app, action);
  add_loop_command(app, action);
  add_locations_command(app, action);
  add_pair_commands(app, action);
  add_score_command(app, action);
  add_release_check_command(app, action);
  return cli::parse_and_act(app, action, argc, argv);
}

}  // namespace
}  // namespace rollrig::validation

int main(int argc, char** argv) {
  return rollrig::cli::run_program(argc, argv, &rollrig::validation::make_and_run,
                                   &rollrig::campaigns::end_other_processes);
}
