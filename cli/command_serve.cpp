#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/command.h"
#include "cli/serve_options.h"

namespace rollrig::cli {
namespace {

/// The options as words, for the other program.
std::vector<std::string> list_words(const ServeOptions& options) {
  std::vector<std::string> words{"--keep", options.keep_folder};
  if (options.port > 0) words.insert(words.end(), {"--port", std::to_string(options.port)});
  if (options.threads > 0) words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  for (const auto& [option, files] : {std::pair{"--tire", &options.tires}, std::pair{"--rig", &options.rigs},
                                      std::pair{"--vehicle", &options.vehicles}}) {
    for (const std::string& file : *files) words.insert(words.end(), {option, file});
  }
  return words;
}

/// Becomes the program that serves, which stands beside this one.
int serve_command(const ServeOptions& options) {
  require_one_process("rollrig serve");
  std::vector<std::string> words{
      (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rollrig_serve").string()};
  for (std::string& word : list_words(options)) words.push_back(std::move(word));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(words.front().c_str(), arguments.data());
  throw usage_error(fmt::format("cannot start {}: {}", words.front(), std::strerror(errno)), "serve", "",
                    "the program rollrig_serve beside rollrig, as it is installed");
}

}  // namespace

void add_serve_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ServeOptions>(
      app, action, "serve", "A page on this computer whose controls are runs, and that diagnoses dropped folders",
      &serve_command);
  add_serve_options(*command, *options);
}

}  // namespace rollrig::cli
