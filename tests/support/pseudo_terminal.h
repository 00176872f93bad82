#pragma once
/// Runs the built program in a terminal, as a person does.

#include <string>
#include <utility>
#include <vector>

namespace rollrig::tests {

struct TerminalResult {
  int status = -1;  // exit status; 128 + signal when it was killed
  std::string sent;
  std::string shown;                                   // what stands on the terminal at the end
  std::vector<std::pair<double, std::string>> pieces;  // what was sent, each with the seconds since the start
};

/// Runs `rollrig <arguments>` through a shell in `folder`, in a pseudo terminal of that many columns.
TerminalResult run_in_terminal(const std::string& arguments, int columns, const std::string& folder = "/tmp");

}  // namespace rollrig::tests
