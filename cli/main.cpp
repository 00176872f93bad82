/// rollrig: the command line.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "cli/command.h"
#include "cli/help_formatter.h"
#include "sim/core/error.h"

namespace rollrig::cli {
namespace {

constexpr const char* kDescription =
    "rollrig: a virtual rolling-resistance laboratory.\n"
    "Simulates tires on test rigs, whole tests at a time.\n";

constexpr const char* kFooter =
    "\nExamples:\n"
    "  rollrig run iso_28580 --tire a50\n"
    "  rollrig run warm_up --tire a60 --set speed_km_h=120 --out warm\n"
    "  rollrig sweep iso_28580 --tire a50 --vary pressure_kPa=210:310:20\n"
    "  rollrig describe iso_28580\n"
    "  rollrig diagnose campaign --json why.json\n"
    "  rollrig diagnose --explain bearing_warmup\n"
    "Exit status: 0 done, 1 a regression differs or a set is doubtful,\n"
    "2 input or usage, 3 the run failed, 70 a mistake in rollrig itself,\n"
    "130 stopped by Ctrl-C. With 2, 3, 70 and 130 nothing is written, except\n"
    "for the points of a sweep that did not fail (3), what is done of a\n"
    "campaign or of a sweep with --out (2, 3, 130), and of several sets\n"
    "those that could be diagnosed (2 or 3).\n";

/// A command's own examples, below its help.
void add_examples(CLI::App& app) {
  static const std::map<std::string, std::string> kExamples{
      {"run",
       "  rollrig run iso_28580 --tire a50\n"
       "  rollrig run warm_up --tire a60 --set speed_km_h=120 --out warm\n"},
      {"sweep", "  rollrig sweep iso_28580 --tire a50 --vary pressure_kPa=210:310:20\n"},
      {"compare",
       "  rollrig compare a40 a50\n"
       "  rollrig compare warm hot --html difference.html\n"},
      {"serve",
       "  rollrig serve\n"
       "  rollrig serve --port 8765 --keep pages --tire mine.toml\n"},
      {"campaign",
       "  rollrig campaign new sums iso_28580 --tire a50 --draw-sd tire \\\n"
       "    --points 1000 --fidelity quasi_static\n"
       "  rollrig campaign run sums\n"
       "  rollrig campaign export sums --csv sums.csv\n"},
      {"fit",
       "  rollrig fit road-load coastdowns.csv --mass 2203\n"
       "  rollrig fit road-load coastdowns.csv --mass 2203 --method wltp\n"
       "  rollrig fit default-road-load --mass 1500 --width 1.8 --height 1.5\n"},
      {"regress", "  rollrig regress runs\n"},
      {"validate", "  rollrig validate campaign\n"},
      {"describe",
       "  rollrig describe iso_28580\n"
       "  rollrig describe a50\n"},
      {"diagnose",
       "  rollrig diagnose campaign --json why.json --html why.html\n"
       "  rollrig diagnose campaign --plan next\n"
       "  rollrig diagnose --explain bearing_warmup\n"},
      {"plan",
       "  rollrig plan --rig drum --hours 8 --tire a50\n"
       "  rollrig plan --rig dyno --hours 16 --out campaign --html campaign.html\n"},
      {"import",
       "  rollrig import logs/import.toml --out campaign\n"
       "  rollrig import --guess logs --tire a50 --rig drum_2m --out campaign\n"},
      {"new",
       "  rollrig new tire --size 205/55R16 --load-index 91 --rrc 8.2\n"
       "  rollrig new rig --diameter 1.7 --inertia 280\n"
       "  rollrig new vehicle --mass 1900 --abc 147.7 -0.237 0.0345\n"
       "  rollrig new set logs --tire a50 --rig drum_2m\n"},
      {"align",
       "  rollrig align tires.csv --reference 1.003 -0.05 --out aligned\n"
       "  rollrig align --apply aligned/alignment.json --rrc 8.1\n"},
      {"label",
       "  rollrig label --rrc 8.4 --class C1\n"
       "  rollrig label --tire c3_315_80r22_5\n"},
      {"export",
       "  rollrig export warm --mat warm.mat\n"
       "  rollrig export fmu --tire a50 --out tire.fmu\n"
       "  rollrig export c3_315_80r22_5 --vecto tire.xml\n"}};
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    const auto of_command = kExamples.find(command->get_name());
    if (of_command != kExamples.end()) command->footer("\nExamples:\n" + of_command->second);
  }
}

/// `rollrig help fit tire` is `rollrig fit tire --help`.
void add_help_command(CLI::App& app, Action& action) {
  const auto help = [&app](const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    std::string name = app.get_name();
    for (const std::string& word : words) {
      const CLI::App* below = find_subcommand(*command, word);
      if (below == nullptr) throw InputError(unknown_name("command", word, list_subcommands(*command)));
      name += " " + below->get_name();
      command = below;
    }
    // not by help(), which is that of the command that was given, "help"
    std::cout << command->get_formatter()->make_help(command, name, CLI::AppFormatMode::Normal);
    return kDone;
  };
  const auto [command, words] =
      add_command<std::vector<std::string>>(app, action, "help", "Print the help of a command", help);
  command->add_option("command", *words, "A command, as in: rollrig help fit tire");
}

/// What was `rollrig blind`.
void add_moved_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("blind", "")->group("");
  command->fallthrough(false)->prefix_command();
  command->callback([&action] {
    action = []() -> int {
      throw InputError({"'rollrig blind' is a program of its own: rollrig_validation, see docs/validation.md", "", 0,
                        "", "", "", ""});
    };
  });
}

struct Command {
  const char* name;
  void (*add)(CLI::App& app, Action& action);
};

/// In the order of the help.
constexpr Command kCommands[] = {{"run", add_run_command},
                                 {"sweep", add_sweep_command},
                                 {"serve", add_serve_command},
                                 {"campaign", add_campaign_command},
                                 {"regress", add_regress_command},
                                 {"validate", add_validate_command},
                                 {"list", add_list_command},
                                 {"describe", add_describe_command},
                                 {"fit", add_fit_command},
                                 {"diagnose", add_diagnose_command},
                                 {"plan", add_plan_command},
                                 {"import", add_import_command},
                                 {"new", add_new_command},
                                 {"export", add_export_command},
                                 {"help", add_help_command},
                                 {"blind", add_moved_command},
                                 {"convert", add_convert_command},
                                 {"align", add_align_command},
                                 {"compare", add_compare_command},
                                 {"label", add_label_command},
                                 {"completion", add_completion_command},
                                 {"man", add_man_command}};

/// Adds only the command that the first argument names: the options of all others take time. Adds all where the first
/// argument names none, and for commands that describe all others.
void add_commands(CLI::App& app, Action& action, const std::string& first_argument) {
  static const std::set<std::string> kTellOfAll{"help", "completion", "man"};
  const auto is_named = [&](const Command& command) { return first_argument == command.name; };
  const bool needs_one =
      std::any_of(std::begin(kCommands), std::end(kCommands), is_named) && kTellOfAll.count(first_argument) == 0;
  for (const Command& command : kCommands) {
    if (!needs_one || is_named(command)) command.add(app, action);
  }
}

int make_and_run(int argc, char** argv) {
  CLI::App app{kDescription, "rollrig"};
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--log", "Log verbosity on standard error; debug shows files, phases and iterations")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->each([](const std::string& level) { spdlog::set_level(spdlog::level::from_str(level)); });
  app.set_version_flag("--version", std::string("rollrig ") + ROLLRIG_VERSION);
  Action action;
  add_commands(app, action, argc > 1 ? argv[1] : "");
  app.footer(kFooter);  // subcommands made after it would repeat it
  add_examples(app);
  return parse_and_act(app, action, argc, argv);
}

}  // namespace
}  // namespace rollrig::cli

int main(int argc, char** argv) { return rollrig::cli::run_program(argc, argv, &rollrig::cli::make_and_run); }
