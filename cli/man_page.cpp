// rollrig man: the manual page, from the same texts as --help.
#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>
#include <iostream>
#include <regex>

#include "cli/command.h"
#include "cli/help_formatter.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

/// Text as roff takes it literally.
std::string escape(std::string text) {
  boost::algorithm::replace_all(text, "\\", "\\e");
  boost::algorithm::replace_all(text, "-", "\\-");
  static const std::regex command("(^|\n)([.'])");
  return std::regex_replace(text, command, "$1\\&$2");
}

/// A text as running lines, short enough as escaping lengthens them.
std::string fill(const std::string& text) {
  constexpr std::size_t kWidth = 72;
  return escape(wrap(text, 0, kWidth));
}

bool is_help(const CLI::Option& option) { return option.check_name("--help"); }

/// What an option takes: TEXT, or its choices; empty for a flag.
std::string name_value(const CLI::Option& option) {
  const std::string value = option.get_positional() ? "" : describe_value(option);
  return value.empty() ? "" : " " + value;
}

std::string format_option(const CLI::Option& option) {
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}", escape(name), escape(name_value(option)), fill(option.get_description()));
}

std::string format_options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (!is_help(*option)) text += format_option(*option);
  }
  return text;
}

std::vector<const CLI::App*> list_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// A command and those below it, each with its options.
std::string format_command(const CLI::App& command, const std::string& path) {
  const std::string name = path + " " + command.get_name();
  std::string text = fmt::format(".SS {}\n{}", escape(name), fill(command.get_description()));
  text += format_options(command);
  for (const CLI::App* below : list_commands(command)) text += format_command(*below, name);
  return text;
}

/// Lines of examples; what follows them is said in other sections.
std::string format_examples(const std::string& footer) {
  constexpr const char* kHeading = "Examples:\n";
  const std::size_t start = footer.find(kHeading);
  const std::size_t end = footer.find("Exit status");
  if (start == std::string::npos) return "";
  return ".SH EXAMPLES\n.nf\n" +
         escape(footer.substr(start + std::string(kHeading).size(), end - start - std::string(kHeading).size())) +
         ".fi\n";
}

constexpr const char* kRest =
    R"(.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 1
a regression differs, or a set that validate or fit tire looked at is doubtful
.TP
.B 2
input or usage; nothing is written, except the other sets of a folder of sets
.TP
.B 3
the run failed; nothing is written, except the other points of a sweep and the
other sets of a folder of sets
.TP
.B 70
a mistake in rollrig itself, with what to report; nothing is half-written
.TP
.B 130
interrupted; nothing is written, except for the finished items of a campaign, or of a sweep with \-\-out
.SH ENVIRONMENT
.TP
.B ROLLRIG_ASSETS
Folder of tires, rigs, vehicles, cycles and sensors, instead of the one that
came with the program.
.SH FILES
.TP
.I ../share/rollrig/assets
seen from the program: what can be named without a path.
)";

std::string make_man_page(const CLI::App& app) {
  std::string text =
      fmt::format(".TH {} 1 {} \"rollrig {}\"\n.SH NAME\n", "ROLLRIG", ROLLRIG_RELEASE_DATE, ROLLRIG_VERSION);
  text += "rollrig \\- a virtual rolling\\-resistance laboratory\n.SH SYNOPSIS\n.B rollrig\n.I command\n";
  text += "[\\fIoptions\\fR]\n.SH DESCRIPTION\n" + fill(app.get_description());
  text += "Every command explains itself with \\fB\\-\\-help\\fR.\n";
  text += ".SH OPTIONS\n" + format_options(app) + ".SH COMMANDS\n";
  for (const CLI::App* command : list_commands(app)) text += format_command(*command, "rollrig");
  return text + format_examples(app.get_footer()) + kRest;
}

}  // namespace

void add_man_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("man", "Print the manual page, for man -l -");
  command->callback([&app, &action] {
    action = [&app] {
      std::cout << make_man_page(app);
      return kDone;
    };
  });
}

}  // namespace rollrig::cli
