/// rollrig: the command line.
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "cli/command.h"
#include "cli/help_formatter.h"
#include "cli/print.h"
#include "cli/typo.h"
#include "sim/core/error.h"
#include "sim/core/interrupt.h"

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
    "2 input or usage, 3 the run failed.\n";

/// A command's own examples, below its help.
void add_examples(const CLI::App& app) {
  static const std::map<std::string, std::string> kExamples{
      {"run",
       "  rollrig run iso_28580 --tire a50\n"
       "  rollrig run warm_up --tire a60 --set speed_km_h=120 --out warm\n"},
      {"sweep", "  rollrig sweep iso_28580 --tire a50 --vary pressure_kPa=210:310:20\n"},
      {"regress", "  rollrig regress runs\n"},
      {"validate", "  rollrig validate campaign\n"},
      {"describe",
       "  rollrig describe iso_28580\n"
       "  rollrig describe a50\n"},
      {"diagnose",
       "  rollrig diagnose campaign --json why.json --html why.html\n"
       "  rollrig diagnose campaign --plan next\n"
       "  rollrig diagnose --explain bearing_warmup\n"},
      {"import", "  rollrig import logs/import.toml --out campaign\n"},
      {"export", "  rollrig export warm --mat warm.mat\n"}};
  for (const auto& [name, examples] : kExamples) app.get_subcommand(name)->footer("\nExamples:\n" + examples);
}

int report(const char* kind, const InputProblem& problem, int status) {
  std::cout << std::flush;
  std::cerr << format_error(std::string(kind) + ": ", problem);
  return status;
}

int report(const char* kind, const std::string& what, int status) {
  std::cout << std::flush;
  std::istringstream text(std::string(kind) + ": " + what);
  for (std::string line; std::getline(text, line);) {
    // Lines that fit are as they should be: those of a list of terms, say.
    std::cerr << (count_characters(line) <= 80 ? line + "\n" : wrap(line, 2).substr(2));
  }
  return status;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{kDescription, "rollrig"};
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--log", "What is said on standard error beside results: debug tells of files, phases and iterations")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->each([](const std::string& level) { spdlog::set_level(spdlog::level::from_str(level)); });
  app.set_version_flag("--version", std::string("rollrig ") + ROLLRIG_VERSION);
  Action action;
  add_run_command(app, action);
  add_sweep_command(app, action);
  add_regress_command(app, action);
  add_validate_command(app, action);
  add_list_command(app, action);
  add_describe_command(app, action);
  add_fit_command(app, action);
  add_diagnose_command(app, action);
  add_import_command(app, action);
  add_export_command(app, action);
  add_blind_command(app, action);
  add_convert_command(app, action);
  add_completion_command(app, action);
  add_man_command(app, action);
  app.footer(kFooter);  // subcommands made after it would repeat it
  add_examples(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    const int status = app.exit(wanted);
    return std::cout.flush() ? status : report("error", "standard output cannot be written to", kInputError);
  } catch (const CLI::ParseError& error) {
    return report("error", explain_usage_error(app, error, argc, argv), kInputError);
  }
  const int status = action();
  if (!std::cout.flush()) throw InputError({"standard output cannot be written to", "", 0, "", "", "space for it", ""});
  return status;
}

}  // namespace
}  // namespace rollrig::cli

int main(int argc, char** argv) {
  using namespace rollrig::cli;
  rollrig::install_interrupt_handler();
  spdlog::set_default_logger(spdlog::stderr_color_mt("rollrig"));
  spdlog::set_pattern("%^%l%$: %v");
  try {
    return parse_and_run(argc, argv);
  } catch (const rollrig::InputError& error) {
    return report("error", error.problem(), kInputError);
  } catch (const rollrig::RunFailure& error) {
    return report("run failed", error.what(), kRunFailed);
  } catch (const rollrig::Interrupted&) {
    return report("stopped", "nothing was written", kInterrupted);
  } catch (const std::exception& error) {
    return report("internal error", error.what(), kRunFailed);
  }
}
