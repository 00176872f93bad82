#pragma once
/// Runs the built program as a user would.

#include <string>

#include "tests/support/temporary_folder.h"

namespace rollrig::tests {

struct ProgramResult {
  int status = -1;  // exit status; 128 + signal when it was killed
  std::string out;
  std::string err;
};

/// Runs `rollrig <arguments>` through a shell in `folder`; `prefix` stands before it ("ulimit -f 8;").
ProgramResult run_program(const std::string& arguments, const std::string& folder = "/tmp",
                          const std::string& prefix = "");
/// Likewise the program of a path.
ProgramResult run_other(const char* program, const std::string& arguments, const std::string& folder = "/tmp",
                        const std::string& prefix = "");
/// Likewise `rollrig_validation`.
ProgramResult run_validation(const std::string& arguments, const std::string& folder = "/tmp",
                             const std::string& prefix = "");

/// Words with one space between, wherever lines end.
std::string flatten(const std::string& text);

}  // namespace rollrig::tests
