// Every command that a page prints works as printed: README.md, CONTRIBUTING.md and docs/. Commands are the lines of
// blocks ```sh. Those of a page run in their order, in one folder that holds what a clone holds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig::tests;

namespace {

struct NotRun {
  std::string kind;  // words that commands of this kind contain
  std::string reason;
};

const std::vector<NotRun> kNotRun{
    {"./check", "installs packages, builds, and runs all tests, this one among them"},
    {"tools/install_packages.sh ", "installs packages"},
    {"apt-get install ", "installs packages"},
    {"python3 -m venv ", "the wheel in a new environment is a test in tests/python"},
    {"pip install ", "the wheel in a new environment is a test in tests/python"},
    {"podman ", "needs a program for containers, and makes an image"},
    {"cmake --", "configures, builds or installs the project"},
    {"ctest --", "runs the tests, this one among them"},
    {"tests/fuzz/", "is not built for users, and takes minutes"},
    {"tools/fuzz ", "builds the readers with Clang, and takes minutes"},
    {"clang-format -i <files>", "the reader names the files"},
    {"rollrig serve", "serves its page until it is stopped"},
    {"mpirun ", "needs MPI and a file of machines"},
    {"fmi-standard", "needs a network"},
    {"$ROLLRIG_MEASURED_DATA", "needs measured data that are not part of rollrig"},
};

/// Pages whose commands take more than some seconds in all; each has a test case of its own.
const std::set<std::string> kSlowPages{
    "README.md",        "docs/diagnosis.md", "docs/machine_pairs.md", "docs/own_tire_and_set.md",
    "docs/tutorial.md", "docs/validation.md"};

/// Pages on which every indented line is printed by a command of the page.
const std::set<std::string> kPagesWithOutput{"docs/convert.md", "docs/how_the_tire_model_works.md",
                                             "docs/own_tire_and_set.md"};

std::vector<std::string> list_pages() {
  std::vector<std::string> pages{"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : fs::directory_iterator(ROLLRIG_SOURCE_DIR "/docs")) {
    if (entry.path().extension() == ".md") pages.push_back("docs/" + entry.path().filename().string());
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

struct PageLines {
  std::vector<std::string> commands;   // in blocks ```sh
  std::vector<std::string> elsewhere;  // indented, or in blocks of another kind; not in equations
};

PageLines read_lines(const std::string& page) {
  PageLines lines;
  std::istringstream in(rollrig::read_text_file(ROLLRIG_SOURCE_DIR "/" + page));
  std::string fence;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("```", 0) == 0 || line == "$$") {
      fence = fence.empty() ? line : "";
    } else if (fence == "$$") {
      continue;
    } else if (fence == "```sh") {
      lines.commands.push_back(line);
    } else if (!fence.empty() || line.rfind("    ", 0) == 0) {
      lines.elsewhere.push_back(line);
    }
  }
  return lines;
}

bool looks_like_command(const std::string& line) {
  if (line.rfind("     ", 0) == 0) return false;  // goes on from the line before
  std::istringstream words(line);
  std::string first;
  std::string second;
  words >> first >> second;
  static const std::set<std::string> others{"$",      "./check", "cmake",   "ctest", "git",
                                            "mpirun", "podman",  "python3", "sudo"};
  const std::string program = first.substr(first.find_last_of('/') + 1);
  const bool is_ours = (program == "rollrig" || program == "rollrig_validation") && !second.empty();
  return is_ours || others.count(first) > 0;
}

const NotRun* find_not_run(const std::string& command) {
  for (const NotRun& one : kNotRun) {
    if (command.find(one.kind) != std::string::npos) return &one;
  }
  return nullptr;
}

/// What a clone holds as far as commands name it; its two programs and its build are those of this test.
void lay_out_clone(const TemporaryFolder& folder) {
  fs::create_symlink(ROLLRIG_PROGRAM, folder.file("rollrig"));
  fs::create_symlink(ROLLRIG_VALIDATION_PROGRAM, folder.file("rollrig_validation"));
  for (const char* source : {"assets", "tests"}) {
    fs::create_directory_symlink(fs::path(ROLLRIG_SOURCE_DIR) / source, folder.file(source));
  }
  fs::create_directory(folder.file("build"));
  fs::create_directory_symlink(ROLLRIG_BINARY_DIR, folder.file("build/release"));
}

void check_commands(const std::string& page) {
  const TemporaryFolder folder;
  lay_out_clone(folder);
  const PageLines lines = read_lines(page);
  std::string printed;
  for (const std::string& command : lines.commands) {
    if (find_not_run(command) != nullptr) continue;
    if (command.rfind("build/release/examples/", 0) == 0 && !fs::exists(folder.file("build/release/examples"))) {
      WARN("not run, since the examples are not built: " << command);
      continue;
    }
    write_file(folder.file("typed.sh"), command + "\n");  // a script, since a comment would hide what follows it
    const ProgramResult result = run_other("sh", "typed.sh", folder.path());
    INFO(page << ": " << command << "\n" << result.out << result.err);
    CHECK(result.status == 0);
    printed += result.out;
  }
  if (kPagesWithOutput.count(page) == 0) return;
  CHECK_FALSE(lines.elsewhere.empty());
  for (const std::string& line : lines.elsewhere) CHECK_THAT(flatten(printed), Catch::Contains(flatten(line)));
}

}  // namespace

TEST_CASE("commands of a page stand in blocks of sh, and each kind that is not run occurs", "[fast]") {
  std::set<std::string> met;
  std::set<std::string> slow_pages;
  for (const std::string& page : list_pages()) {
    const PageLines lines = read_lines(page);
    for (const std::string& line : lines.elsewhere) {
      INFO(page << ": " << line);
      CHECK_FALSE(looks_like_command(line));
    }
    for (const std::string& command : lines.commands) {
      if (const NotRun* one = find_not_run(command)) met.insert(one->kind);
    }
    if (kSlowPages.count(page) > 0 && !lines.commands.empty()) slow_pages.insert(page);
  }
  for (const NotRun& one : kNotRun) {
    INFO(one.kind << ": " << one.reason);
    CHECK(met.count(one.kind) == 1);
  }
  CHECK(slow_pages == kSlowPages);
}

TEST_CASE("every command of the quick pages works as printed", "[slow]") {
  for (const std::string& page : list_pages()) {
    if (kSlowPages.count(page) == 0) check_commands(page);
  }
}

TEST_CASE("every command in README.md works as printed", "[slow]") { check_commands("README.md"); }

TEST_CASE("every command of the tutorial works as printed", "[slow]") { check_commands("docs/tutorial.md"); }

TEST_CASE("every command of the guide to the diagnosis works as printed", "[slow]") {
  check_commands("docs/diagnosis.md");
}

TEST_CASE("every command of the page on two machines works as printed", "[slow]") {
  check_commands("docs/machine_pairs.md");
}

TEST_CASE("every command of the page on files of one's own works as printed", "[slow]") {
  check_commands("docs/own_tire_and_set.md");
}

TEST_CASE("every command of the page on validation works as printed", "[weekly]") {
  check_commands("docs/validation.md");
}
