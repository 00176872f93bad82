#include "sim/core/file_io.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include "sim/core/error.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;

namespace {
std::size_t count_files(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder), {}));
}
}  // namespace

TEST_CASE("an output folder appears whole, or not at all", "[fast]") {
  const tests::TemporaryFolder temporary;
  const fs::path base = temporary.path();
  const std::string target = (base / "results").string();
  {
    OutputFolder folder(target, false);
    folder.add("a.txt", "1");
    CHECK_FALSE(fs::exists(target));  // nothing before commit
  }
  CHECK(count_files(base) == 0);
  OutputFolder folder(target, false);
  folder.add("a.txt", "1");
  folder.add("deep/b.txt", "2");
  folder.commit();
  CHECK(read_text_file(target + "/deep/b.txt") == "2");
  CHECK(count_files(base) == 4);  // no staging folder is left
}

TEST_CASE("a folder with files is refused, and with force only files of the same name go", "[fast]") {
  const tests::TemporaryFolder temporary;
  const fs::path base = temporary.path();
  std::ofstream(base / "keep.txt") << "keep";
  std::ofstream(base / "a.txt") << "old";
  CHECK_THROWS_WITH(OutputFolder(base.string(), false), Catch::Contains("holds files") && Catch::Contains("--force"));
  OutputFolder folder(base.string(), true);
  folder.add("a.txt", "new");
  folder.commit();
  CHECK(read_text_file((base / "a.txt").string()) == "new");
  CHECK(read_text_file((base / "keep.txt").string()) == "keep");
}

TEST_CASE("a failed write keeps what stood there", "[fast]") {
  CHECK_THROWS_AS(write_file_atomically("/proc/rollrig-test", "x"), InputError);
  CHECK_THROWS_AS(write_output("/dev/full", std::string(100000, 'x')), InputError);
  CHECK_THROWS_AS(OutputFolder("/proc/rollrig-test", false), InputError);
}

TEST_CASE("text files are told from what is none", "[fast]") {
  const tests::TemporaryFolder temporary;
  const fs::path base = temporary.path();
  std::ofstream(base / "empty") << "";
  std::ofstream(base / "binary", std::ios::binary) << std::string("\x00\x01", 2);
  std::ofstream(base / "latin1", std::ios::binary) << "caf\xE9";
  CHECK_THROWS_WITH(read_text_file((base / "none").string()), Catch::Contains("no such file"));
  CHECK_THROWS_WITH(read_text_file(base.string()), Catch::Contains("is a directory"));
  CHECK_THROWS_WITH(read_text_file((base / "empty").string()), Catch::Contains("is empty"));
  CHECK_THROWS_WITH(read_text_file((base / "binary").string()), Catch::Contains("not a text file"));
  CHECK_THROWS_WITH(read_text_file((base / "latin1").string()), Catch::Contains("not a text file"));
}

TEST_CASE("SHA-256 of the standard's example", "[fast]") {
  // FIPS 180-2, appendix B.1
  CHECK(calc_sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("a pipe is refused, for whoever waits for it may wait for ever", "[fast]") {
  const tests::TemporaryFolder temporary;
  const std::string pipe = temporary.file("pipe");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(read_text_file(pipe), Catch::Contains("is a pipe, not a file"));
  CHECK_THROWS_WITH(read_text_file(pipe, "utf-8", ""), Catch::Contains("is a pipe, not a file"));
}

TEST_CASE("a file larger than its kind may be is refused before it is read", "[fast]") {
  const tests::TemporaryFolder temporary;
  const std::string file = temporary.file("file");
  std::ofstream(file) << "text";
  fs::resize_file(file, kLargestText_bytes + 1);  // a hole, which takes no room
  CHECK_THROWS_WITH(read_text_file(file), Catch::Contains("is too large") && Catch::Contains("at most 64 MiB"));
  CHECK_THROWS_WITH(read_text_file(file, "utf-8", ""), Catch::Contains("not a text file"));  // of zero bytes
  fs::resize_file(file, kLargestTable_bytes + 1);
  CHECK_THROWS_WITH(read_text_file(file, "utf-8", ""), Catch::Contains("at most 1024 MiB"));
  CHECK_THROWS_WITH(read_binary_file(file), Catch::Contains("at most 1024 MiB"));
  CHECK(read_text_file("/proc/self/status").size() > 100);  // of which the system says that it has no bytes
}

TEST_CASE("names that the system does not follow are errors of the input", "[fast]") {
  const tests::TemporaryFolder temporary;
  const std::string too_long = temporary.file(std::string(300, 'n'));
  CHECK_THROWS_WITH(read_text_file(too_long), Catch::Contains("cannot read") && Catch::Contains("too long"));
  CHECK_THROWS_AS(is_there(too_long), InputError);
  const std::string loop = temporary.file("loop");
  fs::create_symlink("loop", loop);
  CHECK_THROWS_WITH(read_text_file(loop), Catch::Contains("cannot read") && Catch::Contains("symbolic links"));
  CHECK_THROWS_AS(is_there(loop), InputError);
  const std::string latin1 = temporary.file("caf\xE9.toml");
  std::ofstream(latin1) << "text";
  CHECK_THROWS_WITH(read_text_file(latin1), Catch::Contains("the name of a file is not UTF-8"));
  CHECK_FALSE(is_there(temporary.file("none")));
  CHECK(is_there(temporary.path()));
}

TEST_CASE("files are recorded while a recorder is there, and by those around it", "[fast]") {
  const tests::TemporaryFolder temporary;
  for (const char* name : {"a", "b", "c"}) tests::write_file(temporary.file(name), "text");
  const auto path_of = [&temporary](const char* name) { return fs::canonical(temporary.file(name)).string(); };
  read_text_file(temporary.file("a"));
  const ReadRecorder outer;
  read_text_file(temporary.file("b"));
  {
    const ReadRecorder inner;
    read_text_file(temporary.file("c"));
    read_text_file(temporary.file("c"));
    CHECK(inner.list_files() == std::vector<std::string>{path_of("c")});
  }
  CHECK(outer.list_files() == std::vector<std::string>{path_of("b"), path_of("c")});
}
