// Every command in README.md, the tutorial and the explanations, as it is printed there, in their order.
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig::tests;

namespace {

/// Indented lines that begin with ./rollrig or ./rollrig_validation.
std::vector<std::string> find_commands(const std::string& page) {
  std::vector<std::string> commands;
  std::istringstream in(rollrig::read_text_file(ROLLRIG_SOURCE_DIR "/" + page));
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("    ./rollrig", 0) == 0) commands.push_back(line.substr(4));
  }
  return commands;
}

/// A folder that holds what a clone holds as far as commands name it; its two programs are those that were built.
void lay_out_clone(const TemporaryFolder& folder) {
  fs::create_symlink(ROLLRIG_PROGRAM, folder.file("rollrig"));
  fs::create_symlink(ROLLRIG_VALIDATION_PROGRAM, folder.file("rollrig_validation"));
  fs::create_directory_symlink(ROLLRIG_SOURCE_DIR "/assets", folder.file("assets"));
}

void check_commands(const std::string& page, std::size_t least) {
  const TemporaryFolder folder;
  lay_out_clone(folder);
  const std::vector<std::string> commands = find_commands(page);
  CHECK(commands.size() >= least);
  for (const std::string& command : commands) {
    write_file(folder.file("typed.sh"), command + "\n");  // a script, since a comment would hide what follows it
    const ProgramResult result = run_other("sh", "typed.sh", folder.path());
    INFO(page << ": " << command << "\n" << result.out << result.err);
    CHECK(result.status == 0);
  }
}

}  // namespace

TEST_CASE("every command in README.md works as printed, in its order", "[slow]") { check_commands("README.md", 20); }

TEST_CASE("every command of the tutorial works as printed, in its order", "[slow]") {
  check_commands("docs/tutorial.md", 15);
}

TEST_CASE("every command of the start page and of the explanations works as printed", "[slow]") {
  check_commands("docs/index.md", 1);
  check_commands("docs/how_the_tire_model_works.md", 2);
}
