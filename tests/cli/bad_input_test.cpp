// Pairs of a wrong input and the words that the message must have: tests/bad_input/<case>.expected, beside
// the case's file where it has one. First line: "$ " and the arguments ("@" before them: of rollrig_validation), with
// {here} for the folder of the cases, {tmp} for an empty folder that must stay empty, {locked} for one without write
// permission. A "!" before the arguments drops the rights of root, a "%" limits the size of files. Every other line
// must stand in the message; the exit status must be 2.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig;
using tests::flatten;
using tests::run_program;
using tests::TemporaryFolder;

namespace {

struct BadInput {
  std::string arguments;
  std::string prefix;
  std::vector<std::string> words;
  bool of_validation = false;
};

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

BadInput read_case(const fs::path& file) {
  std::istringstream in(tests::read_file(file.string()));
  BadInput bad;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("$ ", 0) == 0) {
      bad.arguments = line.substr(2);
    } else if (!line.empty()) {
      bad.words.push_back(line);
    }
  }
  if (bad.arguments.front() == '@') {
    bad.arguments.erase(0, 1);
    bad.of_validation = true;
  }
  if (bad.arguments.front() == '!') {
    bad.arguments.erase(0, 1);
    if (::geteuid() == 0) bad.prefix = "setpriv --reuid=65534 --regid=65534 --clear-groups";
  } else if (bad.arguments.front() == '%') {
    bad.arguments.erase(0, 1);
    bad.prefix = "trap '' XFSZ; ulimit -f 8;";  // 8 blocks; the signal ignored, so that write() fails
  }
  return bad;
}

/// The program as any user may run it, whatever the rights on the way to the build folder.
bool others_may_run_program() {
  for (fs::path at = fs::path(ROLLRIG_PROGRAM); at != at.root_path(); at = at.parent_path()) {
    if ((fs::status(at).permissions() & fs::perms::others_exec) == fs::perms::none) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("every wrong input is answered with the words that mend it", "[fast]") {
  const fs::path here = fs::path(ROLLRIG_SOURCE_DIR) / "tests/bad_input";
  int cases = 0;
  for (const auto& entry : fs::directory_iterator(here)) {
    if (entry.path().extension() != ".expected") continue;
    ++cases;
    DYNAMIC_SECTION(entry.path().stem().string()) {
      BadInput bad = read_case(entry.path());
      if (bad.prefix.rfind("setpriv", 0) == 0 && !others_may_run_program()) {
        WARN("skipped: the program lies where other users may not run it");
        continue;
      }
      const TemporaryFolder empty;
      const TemporaryFolder locked;
      fs::permissions(locked.path(),
                      fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec | fs::perms::others_read);
      replace_all(bad.arguments, "{here}", here.string());
      replace_all(bad.arguments, "{tmp}", empty.path());
      replace_all(bad.arguments, "{locked}", locked.path());
      const auto run = (bad.of_validation ? tests::run_validation : run_program)(bad.arguments, "/tmp", bad.prefix);
      INFO((bad.of_validation ? "rollrig_validation " : "rollrig ") << bad.arguments << "\n" << run.err);
      CHECK(run.status == 2);
      const std::string flat = flatten(run.err);
      for (const std::string& word : bad.words) CHECK_THAT(flat, Catch::Contains(flatten(word)));
      CHECK(run.out.empty());
      CHECK(empty.entry_count() == 0);
      CHECK(locked.entry_count() == 0);
      fs::permissions(locked.path(), fs::perms::all);
    }
  }
  CHECK(cases >= 40);
}
