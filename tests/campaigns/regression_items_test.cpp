// The runs of a regression as items.
#include "api/regression_items.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using rollrig::read_comparison;
using rollrig::RegressedRun;
using rollrig::RegressionItems;
using rollrig::campaigns::Record;
using rollrig::tests::read_file;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

constexpr const char* kRuns = ROLLRIG_SOURCE_DIR "/assets/regression/";

/// The record of the only run of a folder.
Record carry_out(const TemporaryFolder& folder, const std::string& run) {
  const RegressionItems items(folder.path(), {run});
  REQUIRE(items.count() == 1);
  Record found;
  rollrig::campaigns::carry_out_each(items, {"", "", 0}, {0}, 1, [&found](const Record& record) { found = record; });
  return found;
}

/// With a tire of its own, which the identity of the item must hold.
void make_runs(const TemporaryFolder& folder) {
  for (const char* file : {"skim_a40.toml", "skim_a40.golden.csv"}) fs::copy(kRuns + std::string(file), folder.path());
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/tires/a40.toml", folder.file("own_tire.toml"));
  std::string run = read_file(folder.file("skim_a40.toml"));
  run.replace(run.find("\"a40\""), 5, "\"own_tire.toml\"");
  write_file(folder.file("skim_a40.toml"), run);
}

}  // namespace

TEST_CASE("the record of a regression's run holds its golden and is the same each time", "[fast]") {
  const TemporaryFolder folder;
  make_runs(folder);
  const Record record = carry_out(folder, "skim_a40");
  CHECK(record.failure.empty());
  CHECK(record.item == 0);
  const RegressedRun run = read_comparison("skim_a40", record.result);
  CHECK(run.status == "same");
  CHECK(run.compared > 100);
  CHECK(std::count(run.golden.begin(), run.golden.end(), '\n') ==
        static_cast<std::ptrdiff_t>(run.compared + 1));  // with the header
  const Record again = carry_out(folder, "skim_a40");
  CHECK(again.identity == record.identity);
  CHECK(again.result == record.result);
}

TEST_CASE("a regression's item is another one once a file that it reads has changed", "[fast]") {
  const TemporaryFolder folder;
  make_runs(folder);
  const std::string before = carry_out(folder, "skim_a40").identity;
  for (const char* file : {"skim_a40.toml", "own_tire.toml", "skim_a40.golden.csv"}) {
    INFO(file);
    const std::string content = read_file(folder.file(file));
    write_file(folder.file(file), content + "\n");
    CHECK(carry_out(folder, "skim_a40").identity != before);
    write_file(folder.file(file), content);
    CHECK(carry_out(folder, "skim_a40").identity == before);
  }
}

TEST_CASE("a golden without tolerance and a run that cannot be read survive the record", "[fast]") {
  const TemporaryFolder folder;
  make_runs(folder);
  std::string golden = read_file(folder.file("skim_a40.golden.csv"));
  const std::size_t at = golden.find('\n') + 1;
  const std::string quantity = golden.substr(at, golden.find(',', at) - at);
  write_file(folder.file("skim_a40.golden.csv"),
             golden.substr(0, at) + quantity + ",,-1e9,0,0\n" + golden.substr(golden.find('\n', at) + 1));
  const RegressedRun differs = read_comparison("skim_a40", carry_out(folder, "skim_a40").result);
  CHECK(differs.status == "differs");
  CHECK(std::isinf(differs.worst_share));
  CHECK(differs.worst_quantity == quantity);
  CHECK(read_comparison("none", carry_out(folder, "none").result).status == "bad run file");
}
