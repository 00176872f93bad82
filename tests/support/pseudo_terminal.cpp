#include "tests/support/pseudo_terminal.h"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>

#include "build_paths.h"

namespace rollrig::tests {
namespace {

/// What stands on a terminal after a text with returns to the start of the line: what comes later is on top.
std::string show(const std::string& sent) {
  std::string shown;
  std::vector<std::string> cells;
  std::size_t at = 0;
  const auto end_line = [&] {
    std::string line;
    for (const std::string& cell : cells) line += cell;
    shown += line.erase(line.find_last_not_of(' ') + 1);
    cells.clear();
    at = 0;
  };
  for (const char c : sent) {
    if (c == '\n') {
      end_line();
      shown += '\n';
    } else if (c == '\r') {
      at = 0;
    } else if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) {
      cells.at(at - 1) += c;
    } else {
      if (at == cells.size()) cells.emplace_back();
      cells[at++] = c;
    }
  }
  end_line();
  return shown;
}

}  // namespace

TerminalResult run_in_terminal(const std::string& arguments, int columns, const std::string& folder) {
  const std::string command = "cd '" + folder + "' && exec '" ROLLRIG_PROGRAM "' " + arguments;
  const winsize size{50, static_cast<unsigned short>(columns), 0, 0};
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child < 0) throw std::runtime_error("no pseudo terminal");
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  TerminalResult result;
  const auto start = std::chrono::steady_clock::now();
  char buffer[4096];
  for (ssize_t count = 0; (count = read(terminal, buffer, sizeof buffer)) > 0;) {
    const std::string piece(buffer, static_cast<std::size_t>(count));
    result.pieces.emplace_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), piece);
    result.sent += piece;
  }
  close(terminal);
  int raw = 0;
  waitpid(child, &raw, 0);
  result.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  result.shown = show(result.sent);
  return result;
}

}  // namespace rollrig::tests
