// Names of dropped files cannot lead out of their folder.
#include <catch2/catch.hpp>

#include <filesystem>

#include "serve/refusal.h"
#include "serve/set_folder.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using serve::IncomingFile;
using serve::require_file_name;

TEST_CASE("ordinary names of logs and sets are taken", "[fast]") {
  for (const char* name : {"run.csv", "RUN 1 (2).CSV", "runs/day 1/warm-up.csv", "set.toml", "Prüfstand/Lauf 3.txt",
                           "<img src=x>.csv", "a..b.csv", "log.mf4"}) {
    INFO(name);
    CHECK_NOTHROW(require_file_name(name));
  }
}

TEST_CASE("names that lead out of the folder, or are hidden or no text, are refused", "[fast]") {
  for (const std::string& name : {std::string(),
                                  std::string(".."),
                                  std::string("../run.csv"),
                                  std::string("a/../../run.csv"),
                                  std::string("/etc/passwd.csv"),
                                  std::string("//run.csv"),
                                  std::string("a//run.csv"),
                                  std::string("a/"),
                                  std::string("./run.csv"),
                                  std::string(".hidden.csv"),
                                  std::string("..\\run.csv"),
                                  std::string("a\\run.csv"),
                                  std::string("run\n.csv"),
                                  std::string("run\0.csv", 8),
                                  std::string("run.csv\0.exe", 12),
                                  std::string("run.sh"),
                                  std::string("run"),
                                  std::string("csv"),
                                  std::string("\xff.csv"),
                                  std::string(300, 'a') + ".csv",
                                  std::string("a/b/c/d/e/f/g/run.csv")}) {
    INFO(name);
    CHECK_THROWS_AS(require_file_name(name), serve::Refusal);
  }
}

TEST_CASE("a file that does not come in whole goes again, and none is replaced", "[fast]") {
  const tests::TemporaryFolder folder;
  { IncomingFile(folder.path(), "runs/cut.csv").append("1,2", 3); }
  CHECK_FALSE(fs::exists(folder.file("runs/cut.csv")));
  IncomingFile whole(folder.path(), "runs/whole.csv");
  REQUIRE(whole.append("1,2\n", 4));
  whole.finish();
  CHECK_THROWS_AS(IncomingFile(folder.path(), "runs/whole.csv"), serve::Refusal);
  CHECK_THROWS_AS(IncomingFile(folder.path(), "runs/whole.csv/inside.csv"), serve::Refusal);
  CHECK_THROWS_AS(IncomingFile(folder.path(), "runs"), serve::Refusal);
  CHECK(tests::read_file(folder.file("runs/whole.csv")) == "1,2\n");
}

TEST_CASE("the private folder is this user's alone, and goes with its object", "[fast]") {
  std::string path;
  {
    const serve::PrivateFolder folder;
    path = folder.path();
    CHECK((fs::status(path).permissions() & (fs::perms::group_all | fs::perms::others_all)) == fs::perms::none);
    tests::write_file(path + "/file.csv", "1\n");
  }
  CHECK_FALSE(fs::exists(path));
}
