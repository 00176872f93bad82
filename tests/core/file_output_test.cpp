// What is written: whole or not at all, under names that nobody can foresee, and never over what another program wrote.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <limits>
#include <thread>
#include <vector>

#include "include/rollrig/progress.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using tests::TemporaryFolder;

namespace {

/// The working folder, as long as the object is.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::string& path) : before_(fs::current_path()) { fs::current_path(path); }
  ~WorkingFolder() { fs::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  fs::path before_;
};

unsigned mode_of(const std::string& path) { return static_cast<unsigned>(fs::status(path).permissions()) & 0777U; }

}  // namespace

TEST_CASE("of two that write one new folder the second is refused, and the first loses nothing", "[fast]") {
  const TemporaryFolder base;
  for (const bool is_there : {false, true}) {
    const std::string target = base.file(is_there ? "there" : "new");
    if (is_there) fs::create_directory(target);
    OutputFolder first(target, false);
    OutputFolder second(target, false);
    first.add("result.json", "first");
    second.add("result.json", "second");
    second.add("more.txt", "second");
    second.flush();
    first.commit();
    CHECK_THROWS_WITH(second.commit(), Catch::Contains("another program has just written"));
    CHECK(read_text_file(target + "/result.json") == "first");
    CHECK_FALSE(fs::exists(target + "/more.txt"));
  }
  CHECK(base.entry_count() == 2);  // nothing beside the two folders
}

TEST_CASE("with force the files of two do not stop each other", "[fast]") {
  const TemporaryFolder base;
  OutputFolder first(base.file("out"), true);
  OutputFolder second(base.file("out"), true);
  first.add("a", "first");
  second.add("a", "second");
  first.commit();
  second.commit();
  CHECK(read_text_file(base.file("out/a")) == "second");
}

TEST_CASE("nothing follows a link that was planted under the name that is written first", "[fast]") {
  const TemporaryFolder base;
  tests::write_file(base.file("victim"), "untouched");
  for (const char* name : {"file", "folder"}) {
    fs::create_symlink(base.file("victim"),
                       base.file("." + std::string(name) + ".partial-" + std::to_string(::getpid())));
  }
  write_file_atomically(base.file("file"), "new");
  CHECK(read_text_file(base.file("victim")) == "untouched");
  CHECK(read_text_file(base.file("file")) == "new");
  OutputFolder folder(base.file("folder"), false);
  folder.add("a", "new");
  folder.commit();
  CHECK(read_text_file(base.file("folder/a")) == "new");
}

TEST_CASE("a file that is replaced keeps its permissions, also one that is written in pieces", "[fast]") {
  const TemporaryFolder base;
  const mode_t umask_before = ::umask(022);
  for (const unsigned mode : {0600U, 0444U}) {
    tests::write_file(base.file("file"), "old");
    fs::permissions(base.file("file"), fs::perms(mode));
    StagedOutput output(base.file("file"), "one ");
    output.append("two");
    for (const fs::directory_entry& entry : fs::directory_iterator(base.path())) {
      if (mode == 0600) CHECK(mode_of(entry.path()) == 0600);  // also the new content is for nobody else to read
    }
    output.commit();
    CHECK(read_text_file(base.file("file")) == "one two");
    CHECK(mode_of(base.file("file")) == mode);
    fs::remove(base.file("file"));
  }
  OutputFolder(base.file("out"), false).commit();
  tests::write_file(base.file("out/a"), "old");
  fs::permissions(base.file("out/a"), fs::perms(0600));
  OutputFolder folder(base.file("out"), true);
  folder.add("a", "new");
  folder.add("b", "new");
  folder.commit();
  CHECK(read_text_file(base.file("out/a")) == "new");
  CHECK(mode_of(base.file("out/a")) == 0600);
  CHECK(mode_of(base.file("out/b")) == 0644);
  ::umask(umask_before);
}

TEST_CASE("a link is replaced, and what it points to stays", "[fast]") {
  const TemporaryFolder base;
  tests::write_file(base.file("mine"), "old");
  fs::create_symlink("mine", base.file("link"));
  write_output(base.file("link"), "new");
  CHECK(read_text_file(base.file("mine")) == "old");
  CHECK(!fs::is_symlink(base.file("link")));
}

TEST_CASE("a file that is open cannot be replaced through its link in /proc", "[fast]") {
  const TemporaryFolder base;
  tests::write_file(base.file("open"), "old");
  const int descriptor = ::open(base.file("open").c_str(), O_WRONLY);
  REQUIRE(descriptor >= 0);
  const std::string number = std::to_string(descriptor);
  fs::create_symlink("/dev/fd/" + number, base.file("link"));
  for (const std::string& path : {"/dev/fd/" + number, "/dev/./fd/" + number, base.file("link")}) {
    CHECK_THROWS_WITH(require_writable(path), Catch::Contains("- for standard output"));
    CHECK_THROWS_WITH(write_output(path, "new"), Catch::Contains("- for standard output"));
  }
  ::close(descriptor);
  CHECK(read_text_file(base.file("open")) == "old");
}

TEST_CASE("a pipe without a reader, and one that is full, can be left by Ctrl-C", "[fast]") {
  const TemporaryFolder base;
  const std::string pipe = base.file("pipe");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const std::string more_than_a_pipe_holds(1 << 20, 'x');
  const auto stop_soon = [] {
    return std::async(std::launch::async, [] {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      request_interrupt();
    });
  };
  {
    const auto stop = stop_soon();
    CHECK_THROWS_AS(write_output(pipe, "text"), Interrupted);
    stop.wait();
    clear_interrupt();
  }
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  {
    const auto stop = stop_soon();
    CHECK_THROWS_AS(write_output(pipe, more_than_a_pipe_holds), Interrupted);
    stop.wait();
    clear_interrupt();
  }
  ::close(reader);
  auto received = std::async(std::launch::async, [&pipe] {
    std::ifstream in(pipe, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  });
  write_output(pipe, more_than_a_pipe_holds);
  CHECK(received.get() == more_than_a_pipe_holds);
}

TEST_CASE("in a folder with the sticky bit the file of another user cannot be replaced, which is said before the work",
          "[fast]") {
  if (::geteuid() != 0) return;  // it takes two users
  const TemporaryFolder base;
  fs::permissions(base.path(), fs::perms(01777));
  tests::write_file(base.file("of_root"), "old");
  REQUIRE(::seteuid(65534) == 0);
  CHECK_THROWS_WITH(require_writable(base.file("of_root")), Catch::Contains("belongs to another user"));
  CHECK_NOTHROW(require_writable(base.file("new")));
  REQUIRE(::seteuid(0) == 0);
  CHECK_NOTHROW(require_writable(base.file("of_root")));
}

TEST_CASE("staging files of a killed program count for nothing, and can be removed", "[fast]") {
  const TemporaryFolder base;
  CHECK(!holds_files(base.file("missing")));
  tests::write_file(base.file(".a.json.partial-0123456789abcdef"), "half");
  fs::create_directories(base.file(".out.partial-0123456789abcdef/in"));
  CHECK(!holds_files(base.path()));
  remove_staging_files(base.path());
  CHECK(base.entry_count() == 0);
  tests::write_file(base.file("mine"), "whole");
  CHECK(holds_files(base.path()));
  remove_staging_files(base.path());
  CHECK(base.entry_count() == 1);
}

TEST_CASE("what is staged and not committed leaves nothing, parents included", "[fast]") {
  const TemporaryFolder base;
  {
    OutputFolder folder(base.file("deep/er/out"), false);
    folder.add("a", "1");
    folder.flush();
    const StagedOutput file(base.file("b"), "2");
    CHECK(base.entry_count() > 0);
  }
  CHECK(base.entry_count() == 0);
}

TEST_CASE("a file that is written in pieces appears whole, or not at all", "[fast]") {
  const TemporaryFolder base;
  tests::write_file(base.file("a"), "before");
  {
    StagedOutput file(base.file("a"), "1");
    file.append("2");
  }
  CHECK(read_text_file(base.file("a")) == "before");
  CHECK(base.entry_count() == 1);
  StagedOutput file(base.file("a"), "1");
  file.append("2");
  StagedOutput moved(std::move(file));
  moved.append("3");
  CHECK(read_text_file(base.file("a")) == "before");
  moved.commit();
  CHECK(read_text_file(base.file("a")) == "123");
  CHECK(base.entry_count() == 1);
}

TEST_CASE("a file that came meanwhile is kept where that is asked for", "[fast]") {
  const TemporaryFolder base;
  StagedOutput file(base.file("a"), "late", StagedOutput::Existing::kKeep);
  tests::write_file(base.file("a"), "early");
  CHECK_THROWS_WITH(file.commit(), Catch::Contains("is there already"));
  CHECK(read_text_file(base.file("a")) == "early");
}

TEST_CASE("files are for all to read as the umask says, and a folder that was there keeps its permissions", "[fast]") {
  const TemporaryFolder base;
  const mode_t before = ::umask(022);
  fs::create_directory(base.file("private"));
  fs::permissions(base.file("private"), fs::perms::owner_all);
  std::vector<unsigned> staged_modes;
  for (const char* name : {"open", "private"}) {
    OutputFolder folder(base.file(name), false);
    folder.add("a", "1");
    folder.flush();
    for (const auto& entry : fs::directory_iterator(base.path())) {  // the new folder, before it takes its place
      if (entry.path().filename().string().find(".private.partial-") != 0) continue;
      staged_modes.push_back(mode_of(entry.path()));
    }
    folder.commit();
  }
  CHECK(staged_modes == std::vector<unsigned>{0700});
  write_file_atomically(base.file("b"), "2");
  CHECK(mode_of(base.file("open")) == 0755);
  CHECK(mode_of(base.file("private")) == 0700);
  CHECK(mode_of(base.file("open/a")) == 0644);
  CHECK(mode_of(base.file("b")) == 0644);
  ::umask(077);
  write_file_atomically(base.file("c"), "3");
  CHECK(mode_of(base.file("c")) == 0600);
  ::umask(before);
}

TEST_CASE("the working folder is filled where it is, and what a killed program left there counts for nothing",
          "[fast]") {
  const TemporaryFolder base;
  const WorkingFolder here(base.path());
  fs::create_directory(base.file(".x.partial-0123456789abcdef"));
  OutputFolder folder(".", false);
  folder.add("deep/a", "1");
  folder.commit();
  CHECK(read_text_file("deep/a") == "1");
  CHECK(read_text_file(base.file("deep/a")) == "1");
  CHECK_THROWS_WITH(OutputFolder(".", false), Catch::Contains("holds files already"));
}

TEST_CASE("a folder in the way of a file stops a forced write before the first file goes", "[fast]") {
  const TemporaryFolder base;
  tests::write_file(base.file("a"), "old");
  fs::create_directory(base.file("b"));
  OutputFolder folder(base.path(), true);
  folder.add("a", "new");
  folder.add("b", "new");
  CHECK_THROWS_AS(folder.commit(), InputError);
  CHECK(read_text_file(base.file("a")) == "old");
}

TEST_CASE("a folder that goes while it is written is an error of the user's", "[fast]") {
  const TemporaryFolder base;
  fs::create_directory(base.file("gone"));
  OutputFolder folder(base.file("gone/out"), false);
  folder.add("a", "1");
  folder.flush();
  fs::remove_all(base.file("gone"));
  CHECK_THROWS_AS(folder.commit(), InputError);
  CHECK(base.entry_count() == 0);
}

TEST_CASE("a link to nothing is no folder to write", "[fast]") {
  const TemporaryFolder base;
  fs::create_symlink(base.file("nowhere"), base.file("link"));
  CHECK_THROWS_WITH(OutputFolder(base.file("link"), false), Catch::Contains("link"));
}

TEST_CASE("a document with a number that is not finite is a failed run that names its key", "[fast]") {
  Json json = {{"good", 1.0}, {"list", {{{"sd", 0.5}}, {{"sd", std::numeric_limits<double>::quiet_NaN()}}}}};
  CHECK_THROWS_AS(to_text(json), RunFailure);
  CHECK_THROWS_WITH(to_text(json), Catch::Contains("'list.2.sd'"));
  json["list"][1]["sd"] = -std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(to_text(json), RunFailure);
  json["list"][1]["sd"] = nullptr;
  CHECK(Json::parse(to_text(json)) == json);
}

TEST_CASE("a document may hold a name that is no UTF-8", "[fast]") {
  CHECK_THAT(to_text(Json{{"file", "caf\xE9.csv"}}), Catch::Contains("caf\xEF\xBF\xBD.csv"));
}
