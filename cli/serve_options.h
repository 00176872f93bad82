#pragma once
/// Options of `rollrig serve` and of the program that it becomes.

#include <string>
#include <vector>

#include "cli/command.h"

namespace rollrig::cli {

struct ServeOptions {
  int port = 0;
  std::string keep_folder = "rollrig_serve";
  std::vector<std::string> tires;
  std::vector<std::string> rigs;
  std::vector<std::string> vehicles;
  int threads = 0;
};

void add_serve_options(CLI::App& command, ServeOptions& options);

}  // namespace rollrig::cli
