// What all programs share: options read, errors answered, exit statuses.
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>
#include <streambuf>
#include <tuple>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/message.h"
#include "rollrig/progress.h"
#include "rollrig/version.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/freed_memory.h"
#include "sim/core/shell_word.h"
#include "sim/core/text.h"
#include "sim/core/text_encoding.h"
#include "sim/core/visible.h"

#undef si_value  // a macro of <csignal>, and a name of units.h

namespace rollrig::cli {
namespace {

/// Passes text on to a stream of the system and shows control characters in it: names, paths and values come from
/// files, and a terminal would carry out what they hold.
class VisibleText : public std::streambuf {
 public:
  explicit VisibleText(std::ostream& stream) : stream_(stream), system_(stream.rdbuf(this)) {}
  ~VisibleText() override {
    sync();
    stream_.rdbuf(system_);
  }
  VisibleText(const VisibleText&) = delete;
  VisibleText& operator=(const VisibleText&) = delete;

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char character = traits_type::to_char_type(c);
    return xsputn(&character, 1) == 1 ? c : traits_type::eof();
  }
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    part_.append(text, static_cast<std::size_t>(count));
    const std::string whole = part_.substr(0, find_last_whole());
    part_.erase(0, whole.size());
    return put(whole) ? count : 0;
  }
  int sync() override {
    const bool is_put = put(part_);
    part_.clear();
    return is_put ? system_->pubsync() : -1;
  }

 private:
  bool put(const std::string& text) {
    const std::string shown = show_controls(text);
    const auto count = static_cast<std::streamsize>(shown.size());
    return system_->sputn(shown.data(), count) == count;
  }
  /// End of the last character whose bytes are all there: a character may come in parts.
  std::size_t find_last_whole() const {
    for (std::size_t back = 1; back <= std::min<std::size_t>(3, part_.size()); ++back) {
      const auto byte = static_cast<unsigned char>(part_[part_.size() - back]);
      if ((byte & 0xC0U) == 0x80U) continue;
      const std::size_t length = byte >= 0xF0U ? 4 : byte >= 0xE0U ? 3 : byte >= 0xC0U ? 2 : 1;
      return length > back ? part_.size() - back : part_.size();
    }
    return part_.size();
  }

  std::ostream& stream_;
  std::streambuf* system_;
  std::string part_;
};

/// The same for a message of the log.
class VisibleMessage : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/, spdlog::memory_buf_t& out) override {
    const std::string shown = show_on_one_line({message.payload.data(), message.payload.size()});
    out.append(shown.data(), shown.data() + shown.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<VisibleMessage>(); }
};

void set_up_log() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("rollrig"));
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<VisibleMessage>('*').set_pattern("%^%l%$: %*");
  spdlog::set_formatter(std::move(formatter));
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
    std::cerr << (count_characters(line) <= 80 ? line + "\n" : wrap_message(line));
  }
  return status;
}

/// A mistake of the program itself: what its developers need to know.
int report_internal_error(const std::string& what, int argc, char** argv) {
  std::cout << std::flush;
  std::string command;
  for (int i = 0; i < argc; ++i) {
    command +=
        (i == 0 ? "" : " ") + (i == 0 ? std::filesystem::path(argv[0]).filename().string() : quote_for_shell(argv[i]));
  }
  std::cerr << wrap_message("internal error: " + what)
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

/// A place that the operating system does not let one look at: a name too long, links in a loop, no working folder.
InputProblem file_system_problem(const std::filesystem::filesystem_error& error) {
  const std::string path = error.path1().string();
  const std::string place = path.empty() ? "the working folder" : "'" + path + "'";
  return {fmt::format("cannot access {}: {}", place, error.code().message()),
          "",
          0,
          "",
          "",
          "a place that can be read and searched",
          ""};
}

/// Throws InputError: arguments become names and texts in JSON and TOML, which have no other encoding.
void require_utf8(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (decode_text(argv[i], "utf-8").is_valid) continue;
    throw InputError({"an argument is not UTF-8 text", "command line", 0, fmt::format("argument {}", i), argv[i],
                      "UTF-8; a file or a folder of another name has to be renamed", ""});
  }
}

/// Throws InputError for an option that is given without a text: it would have no effect, unsaid. A file to be written
/// has its own message.
void require_texts(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string>& texts = option->results();
    if (option->get_positional() || std::find(texts.begin(), texts.end(), "") == texts.end()) continue;
    throw usage_error(option->get_name() + " is empty", option->get_name(), "",
                      fmt::format("a text, or no {}", option->get_name()));
  }
  for (const CLI::App* subcommand : app.get_subcommands()) require_texts(*subcommand);
}

/// Calls `make_and_run`. What it throws becomes a message and an exit status.
int answer_errors(int argc, char** argv, int (*make_and_run)(int argc, char** argv)) {
  const VisibleText out(std::cout);
  const VisibleText err(std::cerr);
  try {
    return make_and_run(argc, argv);
  } catch (const InputError& error) {
    return report("error", error.problem(), kInputError);
  } catch (const RunFailure& error) {
    return report("run failed", error.what(), kRunFailed);
  } catch (const Interrupted&) {
    return report("stopped", "nothing was written", kInterrupted);
  } catch (const std::bad_alloc&) {
    return report("run failed", "the memory of this computer does not suffice", kRunFailed);
  } catch (const std::filesystem::filesystem_error& error) {
    return report("error", file_system_problem(error), kInputError);
  } catch (const std::exception& error) {
    return report_internal_error(error.what(), argc, argv);
  } catch (...) {
    return report_internal_error("of unknown kind", argc, argv);
  }
}

}  // namespace

int run_program(int argc, char** argv, int (*make_and_run)(int argc, char** argv), void (*end_others)(int status)) {
  open_closed_streams();
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone costs no files
  keep_freed_memory();
  install_interrupt_handler();
  set_up_log();
  const int status = answer_errors(argc, argv, make_and_run);
  if (status != kDone && end_others != nullptr) end_others(status);
  return status;
}

int parse_and_act(CLI::App& app, const Action& action, int argc, char** argv) {
  require_utf8(argc, argv);
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
  require_texts(app);
  const int status = action();
  flush_standard_output();
  if (!std::cout) end_by_closed_pipe();
  return status;
}

}  // namespace rollrig::cli
