// rollrig blind as users meet it: from making a bank to its score.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"
#include "tests/validation/scoring/bank_folder.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using namespace rollrig::tests;

namespace {

std::size_t count_files(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("make prints the seal that the bank has, and says nothing of the truth", "[fast]") {
  const TemporaryFolder folder;
  const auto made = run_program(
      "blind make --seed 4711 --out bank --kind drum --singles 2 --pairs 0 --none 1 --outside 0", folder.path());
  INFO(made.err);
  REQUIRE(made.status == 0);
  const std::string truth = read_file(folder.file("bank/truth.json"));
  const std::string seal = rollrig::calc_sha256(truth);
  CHECK_THAT(made.out, Contains(seal));
  CHECK(read_file(folder.file("bank/seal.sha256")) == seal + "  truth.json\n");
  CHECK(count_files(folder.file("bank/sets")) == 3);
  for (const auto& [name, set] : json::parse(truth)["sets"].items()) {
    for (const auto& effect : set["effects"])
      CHECK(made.out.find(effect["id"].get<std::string>()) == std::string::npos);
  }
}

TEST_CASE("without the generator beside it, make says what is missing", "[fast]") {
  const TemporaryFolder folder;
  fs::copy_file(ROLLRIG_PROGRAM, folder.file("rollrig"));
  const auto made = run_other(folder.file("rollrig").c_str(), "blind make --seed 1 --out bank", folder.path());
  CHECK(made.status == 2);
  CHECK_THAT(made.err, Contains("rollrig_blind") && Contains("is not there"));
  CHECK_FALSE(fs::exists(folder.file("bank")));
}

TEST_CASE("run and score tell how a bank went, resume, and keep to 80 columns", "[fast]") {
  const BankFolder made;
  const auto first = run_program("blind run bank", made.folder.path());
  INFO(first.err);
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("3 of 3 sets") && Contains("3 now") && Contains("3 not diagnosed"));
  fs::remove(made.answer("0002"));
  const auto missing = run_program("blind score bank", made.folder.path());
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("1 of 3 sets") && Contains("rollrig blind run bank"));
  CHECK_THAT(run_program("blind run bank", made.folder.path()).out, Contains("1 now, 2 before"));
  const auto score = run_program("blind score bank --seal " + made.seal + " --json score.json --markdown score.md",
                                 made.folder.path());
  INFO(score.err);
  REQUIRE(score.status == 0);
  std::istringstream in(score.out);
  for (std::string line; std::getline(in, line);) {
    INFO(line);
    CHECK(line.size() <= 80);
  }
  const json result = json::parse(read_file(made.folder.file("score.json")));
  CHECK(result["format"] == "rollrig-blind-score/1");
  CHECK(result["missed"].size() == 3);
  CHECK_THAT(read_file(made.folder.file("score.md")), Contains("best baseline"));
}

TEST_CASE("a score under another seal is refused and writes nothing", "[fast]") {
  const BankFolder made;
  REQUIRE(run_program("blind run bank --quiet", made.folder.path()).status == 0);
  const auto score =
      run_program("blind score bank --seal " + std::string(64, '1') + " --json score.json", made.folder.path());
  CHECK(score.status == 2);
  CHECK_THAT(score.err, Contains("the seal is broken") && Contains(made.seal));
  CHECK_FALSE(fs::exists(made.folder.file("score.json")));
}

TEST_CASE("a bank whose making is interrupted leaves nothing behind", "[fast]") {
  const TemporaryFolder folder;
  const auto stopped = run_program("blind make --seed 9 --out bank --kind drum --singles 200", folder.path(),
                                   "timeout --foreground -s INT --preserve-status 1");
  CHECK(stopped.status == 130);
  CHECK_THAT(stopped.err, Contains("nothing was written"));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a run that is interrupted leaves whole answers, and goes on from them", "[slow]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("blind make --seed 9 --out bank --kind drum --singles 6 --pairs 0 --none 0 --outside 0",
                      folder.path())
              .status == 0);
  fs::remove(folder.file("bank/truth.json"));  // a run has no use for it
  const auto stopped = run_program("blind run bank --threads 2 --only rim_heat,slow_leak", folder.path(),
                                   "timeout --foreground -s INT --preserve-status 1");
  CHECK(stopped.status == 130);
  CHECK_THAT(stopped.err, Contains("stopped") && Contains("the same command goes on"));
  std::size_t answered = 0;
  for (const auto& entry : fs::directory_iterator(folder.file("bank/answers"))) {
    INFO(entry.path());
    CHECK(entry.path().extension() == ".json");
    CHECK(entry.path().filename().string().front() != '.');
    CHECK_NOTHROW(json::parse(read_file(entry.path().string())));
    ++answered;
  }
  const auto rest = run_program("blind run bank --only rim_heat,slow_leak", folder.path());
  CHECK(rest.status == 0);
  CHECK_THAT(rest.out, Contains(fmt::format("{} now, {} before", 6 - answered, answered)));
}

#ifdef ROLLRIG_MPIEXEC
TEST_CASE("under mpirun the processes share the sets, and one of them prints", "[fast]") {
  const BankFolder made;
  const std::string mpirun =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " ROLLRIG_MPIEXEC " --oversubscribe -n 2";
  const auto run = run_program("blind run bank --threads 1", made.folder.path(), mpirun);
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(flatten(run.out) == "3 of 3 sets answered in bank/answers/: 3 now, 0 before; 3 not diagnosed; 2 processes");
  CHECK(count_files(made.bank + "/answers") == 3);
  CHECK_THAT(run_program("blind run bank", made.folder.path()).out, Contains("0 now, 3 before"));
}
#endif
