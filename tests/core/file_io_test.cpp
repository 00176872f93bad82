#include "sim/core/file_io.h"

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
