#include "cli/typo.h"

#include <fmt/format.h>

#include <algorithm>

namespace rollrig::cli {
namespace {

/// The app whose options were being read: the subcommand named by the leading words, where there is one.
const CLI::App& find_called(const CLI::App& app, int argc, char** argv, int& next) {
  const CLI::App* called = &app;
  for (next = 1; next < argc; ++next) {
    const CLI::App* found = find_subcommand(*called, argv[next]);
    if (found == nullptr) break;
    called = found;
  }
  return *called;
}

std::string suggest(const CLI::App& app, const CLI::App& called, int argc, char** argv, int next) {
  const std::vector<std::string> subcommands = list_subcommands(called);
  if (next < argc && !subcommands.empty() && argv[next][0] != '-') return nearest_name(argv[next], subcommands);
  std::vector<std::string> options = list_options(called);
  for (const std::string& option : list_options(app)) options.push_back(option);
  for (int i = next; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    const bool unknown_option =
        word.rfind("--", 0) == 0 && std::find(options.begin(), options.end(), word) == options.end();
    if (unknown_option) return nearest_name(word, options);
  }
  return {};
}

}  // namespace

std::vector<std::string> list_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* find_subcommand(const CLI::App& app, const std::string& name) {
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (subcommand->get_name() == name) return subcommand;
  }
  return nullptr;
}

std::vector<std::string> list_subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(subcommand->get_name());
  }
  return names;
}

namespace {

/// What is wrong in one sentence: CLI11's, or ours where it names words back to front or not at all.
std::string describe_problem(const CLI::App& app, const CLI::App& called, const CLI::ParseError& error, int argc,
                             char** argv, int next) {
  const bool wants_command = !list_subcommands(called).empty();
  if (wants_command && next < argc && argv[next][0] != '-') return fmt::format("unknown command '{}'", argv[next]);
  std::vector<std::string> left = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || left.empty()) return error.what();
  // An unknown option comes with words that would have been its values.
  const auto option = std::find_if(left.begin(), left.end(), [](const std::string& w) { return w.rfind('-', 0) == 0; });
  if (option != left.end()) return fmt::format("unknown option '{}'", option->substr(0, option->find('=')));
  return fmt::format("{} not expected: {}", left.size() == 1 ? "one word was" : "these words were",
                     fmt::join(left, " "));
}

}  // namespace

InputProblem explain_usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  int next = 1;
  const CLI::App& called = find_called(app, argc, argv, next);
  std::string command = "rollrig";
  for (int i = 1; i < next; ++i) command += std::string(" ") + argv[i];
  return {describe_problem(app, called, error, argc, argv, next),
          "",
          0,
          "",
          "",
          fmt::format("see {} --help", command),
          suggest(app, called, argc, argv, next)};
}

}  // namespace rollrig::cli
