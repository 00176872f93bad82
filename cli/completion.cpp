#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <iostream>

#include "cli/command.h"
#include "cli/help_formatter.h"
#include "rollrig/assets.h"
#include "rollrig/diagnose.h"
#include "sim/core/error.h"

namespace rollrig::cli {
namespace {

/// Words that may follow an option, or be the first argument of a command.
std::vector<std::string> words_after(const std::string& what) {
  if (what == "--tire") return list_assets("tires");
  if (what == "--rig") return list_assets("rigs");
  if (what == "--vehicle") return list_assets("vehicles");
  if (what == "--sensors") return list_assets("sensors");
  if (what == "--fidelity") return {"multibody", "quasi_static"};
  if (what == "--class") return {"C1", "C2", "C3"};
  if (what == "--baseline") return {"combined", "constant_rrc"};
  if (what == "run" || what == "sweep") return names_of(list_scenarios());
  if (what == "--without" || what == "--only") return comparable_names();
  if (what == "--explain") return explainable_names();
  if (what == "list") return list_kinds();
  if (what == "completion") return {"bash", "zsh", "fish"};
  std::vector<std::string> words;
  if (what == "--set" || what == "--vary") {
    for (const char* key : {"cycle=", "program="}) {
      for (const std::string& cycle : list_assets("cycles")) words.push_back(key + cycle);
    }
  }
  if (what == "describe") {
    words = names_of(list_scenarios());
    for (const std::string& id : names_of(list_effects())) words.push_back(id);
    for (const std::string& folder : asset_folders()) {
      for (const std::string& name : list_assets(folder)) words.push_back(name);
    }
  }
  return words;
}

/// The words that may stand at a place of the command line; those of files besides.
struct CompletionRule {
  std::string command;  // "fit tire"; empty before the first command
  std::string option;   // before the place, if that takes a value
  std::vector<std::string> words;
  bool is_list = false;  // of words with commas between

  std::string joined() const { return boost::algorithm::join(words, " "); }
};

/// Rules of a command, of its options and of the commands below it.
void add_rules(const CLI::App& app, const CLI::App& command, const std::string& name,
               std::vector<CompletionRule>& rules) {
  std::vector<std::string> words = words_after(name);
  const std::vector<std::string> below = name == "help" ? list_subcommands(app) : list_subcommands(command);
  words.insert(words.end(), below.begin(), below.end());
  for (const CLI::App* from : {&command, &app}) {
    for (const std::string& option : list_options(*from)) {
      if (std::find(words.begin(), words.end(), option) != words.end()) continue;
      words.push_back(option);
      std::string value = describe_value(*from->get_option(option));
      if (value.empty()) continue;  // a flag
      rules.push_back({name, option, words_after(option), from->get_option(option)->get_delimiter() != '\0'});
      if (value.find('|') == std::string::npos) continue;
      std::replace(value.begin(), value.end(), '|', ' ');
      rules.back().words = {value};
    }
  }
  rules.push_back({name, "", words});
  if (&command != &app && !below.empty() && name != "help") rules.push_back({"help " + name, "", below});
  for (const std::string& one : list_subcommands(command)) {
    add_rules(app, *find_subcommand(command, one), name.empty() ? one : name + " " + one, rules);
  }
}

/// What bash and zsh share: from $words, $cur and $prev to $list, and $many where commas may stand between its words.
std::string make_cases(const std::vector<CompletionRule>& rules) {
  std::string commands, options, others;
  for (const CompletionRule& rule : rules) {
    if (rule.option.empty()) {
      commands += fmt::format("{}'{}'", commands.empty() ? "" : "|", rule.command);
      others += fmt::format("      '{}') list='{}';;\n", rule.command, rule.joined());
    } else {
      options += fmt::format("    '{} {}') list='{}'{};;\n", rule.command, rule.option, rule.joined(),
                             rule.is_list ? " many=1" : "");
    }
  }
  return "    case \"${called:+$called }$w\" in " + commands + ") called=\"${called:+$called }$w\";; esac\n  done\n" +
         "  case \"$called $prev\" in\n" + options + "    *) case $called in\n" + others + "    esac;;\n  esac\n";
}

/// Bash takes "=" for a word of its own: the words are joined again, and what stands before it is left out of replies.
std::string make_bash(const std::vector<CompletionRule>& rules) {
  return R"(_rollrig() {
  local words=() w cur prev= called= list= many= start=
  for w in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ ${#words[@]} -gt 0 && ( $w == "=" || ${words[-1]} == *= ) ]]; then words[-1]+=$w; else words+=("$w"); fi
  done
  cur=${words[-1]}
  unset 'words[-1]'
  [[ ${#words[@]} -gt 0 ]] && prev=${words[-1]}
  [[ $cur == --*=* ]] && prev=${cur%%=*} cur=${cur#*=}
  for w in "${words[@]}"; do
)" + make_cases(rules) +
         R"(  [[ $many ]] && start=${cur%"${cur##*,}"}
  mapfile -t COMPREPLY < <(compgen -P "$start" -W "$list" -- "${cur#"$start"}" || compgen -f -- "$cur")
  [[ $cur == *=* ]] && COMPREPLY=("${COMPREPLY[@]#"${cur%=*}="}")
}
complete -F _rollrig rollrig
)";
}

/// A file of a folder in $fpath, and as well for eval.
std::string make_zsh(const std::vector<CompletionRule>& rules) {
  return R"(#compdef rollrig
_rollrig() {
  local w cur=${words[CURRENT]} prev=${words[CURRENT-1]} called= list= many=
  [[ $cur == --*=* ]] && prev=${cur%%=*} && compset -P 1 '*='
  for w in "${(@)words[2,CURRENT-1]}"; do
)" + make_cases(rules) +
         R"(  [[ -n $many ]] && compset -P '*,'
  compadd -- ${=list} || _files
}
if [[ ${funcstack[1]} == _rollrig ]]; then _rollrig "$@"; else compdef _rollrig rollrig; fi
)";
}

/// Of each command its options, those that take a value with its words, and its own words.
std::string make_fish(const CLI::App& app, const std::vector<CompletionRule>& rules) {
  std::string script;
  for (const std::string& name : list_subcommands(app)) {
    script += fmt::format("complete -c rollrig -n __fish_use_subcommand -f -a {} -d '{}'\n", name,
                          find_subcommand(app, name)->get_description());
  }
  for (const CompletionRule& rule : rules) {
    const std::string seen =
        boost::algorithm::replace_all_copy(rule.command, " ", "; and __fish_seen_subcommand_from ");
    const std::string start = rule.command.empty()
                                  ? "complete -c rollrig -n __fish_use_subcommand"
                                  : fmt::format("complete -c rollrig -n '__fish_seen_subcommand_from {}'", seen);
    std::string own;
    for (const std::string& word : rule.option.empty() ? rule.words : std::vector<std::string>{}) {
      if (word.rfind("--", 0) != 0) own += (own.empty() ? "" : " ") + word;
      if (word.rfind("--", 0) == 0) script += fmt::format("{} -l {}\n", start, word.substr(2));
    }
    if (!rule.option.empty()) {
      script += fmt::format(rule.is_list ? "{} -l {} -r -a '(__fish_append , {})'\n" : "{} -l {} -r -a '{}'\n", start,
                            rule.option.substr(2), rule.joined());
    } else if (!own.empty() && !rule.command.empty()) {
      script += fmt::format("{} -a '{}'\n", start, own);
    }
  }
  return script;
}

int completion_command(const CLI::App& app, const std::string& shell) {
  std::vector<CompletionRule> rules;
  add_rules(app, app, "", rules);
  if (shell == "bash") {
    std::cout << make_bash(rules);
  } else if (shell == "zsh") {
    std::cout << make_zsh(rules);
  } else if (shell == "fish") {
    std::cout << make_fish(app, rules);
  } else {
    throw InputError(unknown_name("shell", shell, {"bash", "zsh", "fish"}));
  }
  return kDone;
}

}  // namespace

void add_completion_command(CLI::App& app, Action& action) {
  const auto [command, shell] =
      add_command<std::string>(app, action, "completion", "Print a completion script: bash, zsh or fish",
                               [&app](const std::string& name) { return completion_command(app, name); });
  command->footer("Use: eval \"$(rollrig completion bash)\"");
  command->add_option("shell", *shell, "bash, zsh or fish")->required();
}

}  // namespace rollrig::cli
