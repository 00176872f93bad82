#include "tests/support/run_program.h"
#include "build_paths.h"

#include <sstream>

#include <sys/wait.h>

#include <cstdlib>

namespace rollrig::tests {

ProgramResult run_other(const char* program, const std::string& arguments, const std::string& folder,
                        const std::string& prefix) {
  const TemporaryFolder logs;
  const std::string command = "cd '" + folder + "' && { " + prefix + " '" + program + "' " + arguments + "; } > '" +
                              logs.file("out") + "' 2> '" + logs.file("err") + "'";
  const int raw = std::system(command.c_str());  // NOLINT: a shell is wanted here
  ProgramResult result;
  result.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  result.out = read_file(logs.file("out"));
  result.err = read_file(logs.file("err"));
  return result;
}

ProgramResult run_program(const std::string& arguments, const std::string& folder, const std::string& prefix) {
  return run_other(ROLLRIG_PROGRAM, arguments, folder, prefix);
}

ProgramResult run_validation(const std::string& arguments, const std::string& folder, const std::string& prefix) {
  return run_other(ROLLRIG_VALIDATION_PROGRAM, arguments, folder, prefix);
}

std::string flatten(const std::string& text) {
  std::istringstream in(text);
  std::string flat;
  for (std::string word; in >> word;) flat += (flat.empty() ? "" : " ") + word;
  return flat;
}

}  // namespace rollrig::tests
