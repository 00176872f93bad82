// Usage errors with the nearest known name.
#include <fmt/format.h>

#include <algorithm>

#include "cli/command.h"

namespace rollrig::cli {
namespace {

/// A call as far as it was understood.
struct Call {
  const CLI::App& app;
  const CLI::App* called;          // whose options were being read: the subcommand that the leading words name
  std::vector<std::string> words;  // as typed
  std::string command;             // the program and its subcommands
  std::size_t next = 0;            // the first word that names none

  /// The word in place of a subcommand, where one is wanted; otherwise nothing.
  std::string find_unknown_command() const {
    const bool takes_words =
        !called->get_options([](const CLI::Option* option) { return option->get_positional(); }).empty();
    const bool wants_command = !takes_words && !list_subcommands(*called).empty();
    return wants_command && next < words.size() && words[next][0] != '-' ? words[next] : "";
  }
};

/// How many words an option of the program itself takes, with its name; 0 where the word is none.
std::size_t count_words_of_option(const CLI::App& app, const std::string& word) {
  const CLI::Option* option = app.get_option_no_throw(word.substr(0, word.find('=')));
  if (option == nullptr || word.rfind('-', 0) != 0) return 0;
  const bool takes_next = option->get_items_expected_min() > 0 && word.find('=') == std::string::npos;
  return takes_next ? 2 : 1;
}

Call read_call(const CLI::App& app, int argc, char** argv) {
  Call call{app, &app, {argv + 1, argv + argc}, app.get_name()};
  while (call.next < call.words.size() && count_words_of_option(app, call.words[call.next]) > 0) {
    call.next += count_words_of_option(app, call.words[call.next]);
  }
  call.next = std::min(call.next, call.words.size());
  for (; call.next < call.words.size(); ++call.next) {
    const CLI::App* found = find_subcommand(*call.called, call.words[call.next]);
    if (found == nullptr) break;
    call.called = found;
    call.command += " " + call.words[call.next];
  }
  return call;
}

std::string suggest(const Call& call) {
  const std::string command = call.find_unknown_command();
  if (!command.empty()) return nearest_name(command, list_subcommands(*call.called));
  std::vector<std::string> options = list_options(*call.called);
  for (const std::string& option : list_options(call.app)) options.push_back(option);
  for (std::size_t i = call.next; i < call.words.size(); ++i) {
    const std::string word = call.words[i].substr(0, call.words[i].find('='));
    const bool is_known = std::find(options.begin(), options.end(), word) != options.end();
    if (word.rfind("--", 0) == 0 && !is_known) return nearest_name(word, options);
  }
  return {};
}

/// What is wrong in one sentence: CLI11's, or ours where it names words back to front or not at all.
std::string describe_problem(const Call& call, const CLI::ParseError& error) {
  const std::string command = call.find_unknown_command();
  if (!command.empty()) return fmt::format("unknown command '{}'", command);
  std::vector<std::string> left = call.app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || left.empty()) return error.what();
  // An unknown option comes with words that would have been its values.
  const auto option = std::find_if(left.begin(), left.end(), [](const std::string& w) { return w.rfind('-', 0) == 0; });
  if (option != left.end()) return fmt::format("unknown option '{}'", option->substr(0, option->find('=')));
  return fmt::format("{} not expected: {}", left.size() == 1 ? "one word was" : "these words were",
                     fmt::join(left, " "));
}

}  // namespace

std::vector<std::string> list_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* find_subcommand(const CLI::App& app, const std::string& name) {
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (subcommand->check_name(name)) return subcommand;
  }
  return nullptr;
}

std::vector<std::string> list_subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!subcommand->get_group().empty()) names.push_back(subcommand->get_name());
  }
  return names;
}

InputProblem explain_usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const Call call = read_call(app, argc, argv);
  return {describe_problem(call, error), "", 0, "", "", fmt::format("see {} --help", call.command), suggest(call)};
}

}  // namespace rollrig::cli
