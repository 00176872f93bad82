#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/typo.h"
#include "rollrig/assets.h"
#include "rollrig/diagnose.h"
#include "sim/core/error.h"

namespace rollrig::cli {
namespace {

/// Words that may follow an option or stand as the first argument of a subcommand.
std::string words_after(const std::string& what) {
  std::vector<std::string> words;
  if (what == "--tire") words = list_assets("tires");
  if (what == "--rig") words = list_assets("rigs");
  if (what == "--vehicle") words = list_assets("vehicles");
  if (what == "--sensors") words = list_assets("sensors");
  if (what == "--fidelity") words = {"multibody", "quasi_static"};
  if (what == "--baseline") words = {"combined", "constant_rrc"};
  if (what == "run" || what == "sweep") words = names_of(list_scenarios());
  if (what == "--without" || what == "--only") words = comparable_names();
  if (what == "--explain") words = explainable_names();
  if (what == "list") words = list_kinds();
  if (what == "completion") words = {"bash", "zsh", "fish"};
  if (what == "describe") {
    words = names_of(list_scenarios());
    for (const std::string& id : names_of(list_effects())) words.push_back(id);
    for (const char* folder : {"tires", "rigs", "vehicles", "sensors"}) {
      for (const std::string& name : list_assets(folder)) words.push_back(name);
    }
  }
  return fmt::format("{}", fmt::join(words, " "));
}

constexpr const char* kOptionsWithWords[] = {"--tire",     "--rig",     "--vehicle", "--sensors", "--fidelity",
                                             "--baseline", "--explain", "--without", "--only"};

/// What may follow a subcommand: words of its own, subcommands below it, options of all of them.
std::string list_words(const CLI::App& app, const std::string& name) {
  const CLI::App* command = find_subcommand(app, name);
  std::string words = words_after(name);
  const auto add = [&words](const std::vector<std::string>& more) {
    if (!more.empty()) words += fmt::format("{}{}", words.empty() ? "" : " ", fmt::join(more, " "));
  };
  add(list_subcommands(*command));
  add(list_options(*command));
  for (const std::string& below : list_subcommands(*command)) add(list_options(*find_subcommand(*command, below)));
  return words;
}

std::string make_bash(const CLI::App& app) {
  std::string script = "_rollrig() {\n  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n";
  script += "  case $prev in\n";
  for (const char* option : kOptionsWithWords) {
    script +=
        fmt::format("    {}) COMPREPLY=($(compgen -f -W \"{}\" -- \"$cur\")); return;;\n", option, words_after(option));
  }
  script += "  esac\n  if [ $COMP_CWORD -eq 1 ]; then\n";
  script += fmt::format("    COMPREPLY=($(compgen -W \"{}\" -- \"$cur\")); return\n  fi\n",
                        fmt::join(list_subcommands(app), " "));
  script += "  case ${COMP_WORDS[1]} in\n";
  for (const std::string& name : list_subcommands(app)) {
    script += fmt::format("    {}) COMPREPLY=($(compgen -f -W \"{}\" -- \"$cur\"));;\n", name, list_words(app, name));
  }
  return script + "  esac\n}\ncomplete -F _rollrig rollrig\n";
}

/// A file of a folder in $fpath, and as well for eval.
std::string make_zsh(const CLI::App& app) {
  std::string script = "#compdef rollrig\n_rollrig() {\n  case ${words[CURRENT-1]} in\n";
  for (const char* option : kOptionsWithWords) {
    script += fmt::format("    {}) compadd -- {}; _files; return;;\n", option, words_after(option));
  }
  script += "  esac\n  if (( CURRENT == 2 )); then\n";
  script += fmt::format("    compadd -- {}; return\n  fi\n", fmt::join(list_subcommands(app), " "));
  script += "  case ${words[2]} in\n";
  for (const std::string& name : list_subcommands(app)) {
    script += fmt::format("    {}) compadd -- {};;\n", name, list_words(app, name));
  }
  return script +
         "  esac\n  _files\n}\n"
         "if [[ ${funcstack[1]} == _rollrig ]]; then _rollrig \"$@\"; else compdef _rollrig rollrig; fi\n";
}

std::string make_fish(const CLI::App& app) {
  std::string script = "complete -c rollrig -n __fish_use_subcommand -f\n";
  for (const std::string& name : list_subcommands(app)) {
    const CLI::App* command = find_subcommand(app, name);
    script +=
        fmt::format("complete -c rollrig -n __fish_use_subcommand -a {} -d '{}'\n", name, command->get_description());
    const std::string on = fmt::format("complete -c rollrig -n '__fish_seen_subcommand_from {}'", name);
    if (!words_after(name).empty()) script += fmt::format("{} -a '{}'\n", on, words_after(name));
    for (const std::string& nested : list_subcommands(*command)) script += fmt::format("{} -a {}\n", on, nested);
    for (const std::string& option : list_options(*command)) {
      const std::string words = words_after(option);
      script += fmt::format("{} -l {}{}\n", on, option.substr(2), words.empty() ? "" : " -x -a '" + words + "'");
    }
  }
  return script;
}

int completion_command(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") {
    std::cout << make_bash(app);
  } else if (shell == "zsh") {
    std::cout << make_zsh(app);
  } else if (shell == "fish") {
    std::cout << make_fish(app);
  } else {
    throw InputError(unknown_name("shell", shell, {"bash", "zsh", "fish"}));
  }
  return kDone;
}

}  // namespace

void add_completion_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("completion", "Print a completion script: bash, zsh or fish");
  command->footer("Use: eval \"$(rollrig completion bash)\"");
  auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")->required();
  command->callback([&app, shell, &action] { action = [&app, shell] { return completion_command(app, *shell); }; });
}

}  // namespace rollrig::cli
