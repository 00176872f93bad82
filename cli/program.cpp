// What all programs share: options read, errors answered, exit statuses.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <iostream>
#include <sstream>

#include "cli/command.h"
#include "rollrig/progress.h"
#include "sim/core/error.h"
#include "sim/core/freed_memory.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

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

}  // namespace

int run_program(const std::function<int()>& body) {
  keep_freed_memory();
  install_interrupt_handler();
  spdlog::set_default_logger(spdlog::stderr_color_mt("rollrig"));
  spdlog::set_pattern("%^%l%$: %v");
  try {
    return body();
  } catch (const InputError& error) {
    return report("error", error.problem(), kInputError);
  } catch (const RunFailure& error) {
    return report("run failed", error.what(), kRunFailed);
  } catch (const Interrupted&) {
    return report("stopped", "nothing was written", kInterrupted);
  } catch (const std::exception& error) {
    return report("internal error", error.what(), kRunFailed);
  }
}

int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv) {
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

}  // namespace rollrig::cli
