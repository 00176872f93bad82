// What all programs share: options read, errors answered, exit statuses.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <tuple>

#include <fmt/format.h>

#include "cli/command.h"
#include "rollrig/progress.h"
#include "rollrig/version.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/freed_memory.h"
#include "sim/core/text.h"

#undef si_value  // a macro of <csignal>, and a name of units.h

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

/// A word as a shell reads it.
std::string quote_word(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

/// A mistake of the program itself: what its developers need to know.
int report_internal_error(const std::string& what, int argc, char** argv) {
  std::cout << std::flush;
  std::string command;
  for (int i = 0; i < argc; ++i) {
    command +=
        (i == 0 ? "" : " ") + (i == 0 ? std::filesystem::path(argv[0]).filename().string() : quote_word(argv[i]));
  }
  std::cerr << wrap("internal error: " + what, 2).substr(2)
            << wrap(
                   "This is a mistake in rollrig, not in what you gave. No file is left half-written. Please report it "
                   "to the rollrig developers where you got rollrig, with these lines and the files that the command "
                   "reads:",
                   2)
            << fmt::format("  version  rollrig {}\n  command  {}\n", library_version(), command);
  return kInternalError;
}

/// Descriptors 0, 1 and 2 that were closed are opened: else the next file that is opened would have one of them, and
/// what is printed would land in it. Writing to standard output then fails as on a full disk.
void open_closed_streams() {
  for (const auto& [descriptor, device, flags] :
       {std::tuple{STDIN_FILENO, "/dev/null", O_RDONLY}, std::tuple{STDOUT_FILENO, "/dev/full", O_WRONLY},
        std::tuple{STDERR_FILENO, "/dev/null", O_WRONLY}}) {
    if (::fcntl(descriptor, F_GETFD) >= 0) continue;
    const int opened = ::open(device, flags);
    if (opened < 0 || opened == descriptor) continue;
    ::dup2(opened, descriptor);
    ::close(opened);
  }
}

/// As other programs end whose reader has gone (`rollrig list | head -1`): silently, by the signal.
void end_by_closed_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

}  // namespace

int run_program(int argc, char** argv, const std::function<int()>& body) {
  open_closed_streams();
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone costs no files
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
  } catch (const std::bad_alloc&) {
    return report("run failed", "there is not enough memory", kRunFailed);
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    return report("error", {fmt::format("'{}': {}", path, error.code().message()), path, 0, "", "", "", ""},
                  kInputError);
  } catch (const std::exception& error) {
    return report_internal_error(error.what(), argc, argv);
  } catch (...) {
    return report_internal_error("of unknown kind", argc, argv);
  }
}

int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    const int status = app.exit(wanted);
    flush_standard_output();
    if (!std::cout) end_by_closed_pipe();
    return status;
  } catch (const CLI::ParseError& error) {
    return report("error", explain_usage_error(app, error, argc, argv), kInputError);
  }
  const int status = action();
  flush_standard_output();
  if (!std::cout) end_by_closed_pipe();
  return status;
}

}  // namespace rollrig::cli
