// rollrig_validation as users meet it: from making a validation set to its score.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"
#include "tests/validation/scoring/validation_set_folder.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using namespace rollrig::tests;

namespace {

std::size_t count_files(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("make prints the hash that the truth has, and says nothing of the truth", "[fast]") {
  const TemporaryFolder folder;
  const auto made = run_validation("make --seed 4711 --out set --kind drum --singles 2 --pairs 0 --none 1 --outside 0",
                                   folder.path());
  INFO(made.err);
  REQUIRE(made.status == 0);
  const std::string truth = read_file(folder.file("set/truth.json"));
  const std::string hash = rollrig::calc_sha256(truth);
  CHECK_THAT(made.out, Contains(hash));
  CHECK(read_file(folder.file("set/truth.sha256")) == hash + "  truth.json\n");
  CHECK(count_files(folder.file("set/sets")) == 3);
  const json cases = json::parse(truth)["sets"];
  REQUIRE(cases.size() == 3);
  for (const auto& [name, set] : cases.items()) {
    for (const auto& effect : set["effects"])
      CHECK(made.out.find(effect["id"].get<std::string>()) == std::string::npos);
  }
}

TEST_CASE("what was rollrig blind says where it is now", "[fast]") {
  for (const char* words : {"blind", "blind make --seed 1 --out set", "blind run bank --quiet"}) {
    const auto moved = run_program(words);
    CHECK(moved.status == 2);
    CHECK(flatten(moved.err) ==
          "error: 'rollrig blind' is a program of its own: rollrig_validation, see docs/validation.md");
  }
  CHECK(run_program("--help").out.find("blind") == std::string::npos);
}

TEST_CASE("a validation set with the names that it once had, made and scored by the old words", "[slow]") {
  const ValidationSetFolder made;
  fs::rename(made.root + "/truth.sha256", made.root + "/seal.sha256");
  REQUIRE(run_validation("run set --quiet", made.folder.path()).status == 0);
  CHECK(run_validation("oracle set --race alone --quiet --seal " + made.hash, made.folder.path()).status == 0);
  write_file(made.root + "/ceiling.json", R"({"sets": {"0002": {"d_prime": 7.5}}})");
  const auto score =
      run_validation("score set --seal " + made.hash + " --oracle set/answers-alone", made.folder.path());
  INFO(score.err);
  CHECK(score.status == 0);
  CHECK_THAT(score.out, Contains("d' 7.5"));
  const auto old = run_validation("bank --each 1 --effects slow_leak --none 0 --runs 1 --out new", made.folder.path());
  CHECK(old.status == 0);
  CHECK(count_files(made.folder.file("new/sets")) == 1);
}

TEST_CASE("run and score tell how a validation set went, resume, and keep to 80 columns", "[slow]") {
  const ValidationSetFolder made;
  const auto first = run_validation("run set", made.folder.path());
  INFO(first.err);
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("3 of 3 cases") && Contains("3 now") && Contains("3 not diagnosed"));
  fs::remove(made.answer("0002"));
  const auto missing = run_validation("score set", made.folder.path());
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("1 of 3 cases") && Contains("rollrig_validation run set"));
  CHECK_THAT(run_validation("run set", made.folder.path()).out, Contains("1 now, 2 before"));
  const auto score =
      run_validation("score set --hash " + made.hash + " --json score.json --markdown score.md", made.folder.path());
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

TEST_CASE("a score under another hash is refused and writes nothing", "[fast]") {
  const ValidationSetFolder made;
  REQUIRE(run_validation("run set --quiet", made.folder.path()).status == 0);
  const auto score =
      run_validation("score set --hash " + std::string(64, '1') + " --json score.json", made.folder.path());
  CHECK(score.status == 2);
  CHECK_THAT(score.err, Contains("another hash") && Contains(made.hash));
  CHECK_FALSE(fs::exists(made.folder.file("score.json")));
}

TEST_CASE("a validation set whose making is interrupted leaves nothing behind", "[slow]") {
  const TemporaryFolder folder;
  const auto stopped = run_validation("make --seed 9 --out set --kind drum --singles 200", folder.path(),
                                      "timeout --foreground -s INT --preserve-status 1");
  CHECK(stopped.status == 130);
  CHECK_THAT(stopped.err, Contains("nothing was written"));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a run that is interrupted leaves whole answers, and goes on from them", "[slow]") {
  const TemporaryFolder folder;
  REQUIRE(
      run_validation("make --seed 9 --out set --kind drum --singles 6 --pairs 0 --none 0 --outside 0", folder.path())
          .status == 0);
  fs::remove(folder.file("set/truth.json"));  // a run has no use for it
  const auto stopped = run_validation("run set --threads 2 --only rim_heat,slow_leak", folder.path(),
                                      "timeout --foreground -s INT --preserve-status 1");
  CHECK(stopped.status == 130);
  CHECK_THAT(stopped.err, Contains("stopped") && Contains("the same command goes on"));
  std::size_t answered = 0;
  for (const auto& entry : fs::directory_iterator(folder.file("set/answers"))) {
    INFO(entry.path());
    CHECK(entry.path().extension() == ".json");
    CHECK(entry.path().filename().string().front() != '.');
    CHECK_NOTHROW(json::parse(read_file(entry.path().string())));
    ++answered;
  }
  const auto rest = run_validation("run set --only rim_heat,slow_leak", folder.path());
  CHECK(rest.status == 0);
  CHECK_THAT(rest.out, Contains(fmt::format("{} now, {} before", 6 - answered, answered)));
}

TEST_CASE("processes without MPI answer the cases of their part", "[fast]") {
  const ValidationSetFolder made;
  const auto first = run_validation("run set --shard 1/2", made.folder.path());
  INFO(first.out << first.err);
  CHECK(first.status == 0);
  const std::size_t answered = count_files(made.root + "/answers");
  CHECK(answered >= 1);
  CHECK(answered <= 2);
  CHECK_THAT(flatten(first.out), Contains("part 1 of 2"));
  const auto second = run_validation("run set", made.folder.path(),
                                     "env SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=2");
  CHECK_THAT(flatten(second.out), Contains(fmt::format("{} now, 0 before", 3 - answered)));
  CHECK(count_files(made.root + "/answers") == 3);
  CHECK(run_validation("run set --shard 3/2", made.folder.path()).status == 2);
}

TEST_CASE("a seed is a whole number that is not negative", "[slow]") {
  const ValidationSetFolder made;
  for (const char* seed : {"-1", "1.5", "18446744073709551616", "1e3", "''"}) {
    for (const char* words :
         {"make --out new --kind drum --singles 1 --pairs 0 --none 0 --outside 0 --seed ",
          "make-case --kind drum --out new --seed ", "plan set --seed ", "loop set --hours 8 --seed "}) {
      INFO(words << seed);
      const auto run = run_validation(words + std::string(seed), made.folder.path());
      CHECK(run.status == 2);
      CHECK_THAT(flatten(run.err), Contains("is no seed") && Contains("--seed"));
    }
  }
  CHECK(!fs::exists(made.folder.file("new")));
  CHECK(run_validation("make-case --kind drum --out new --runs 1 --seed 18446744073709551615", made.folder.path())
            .status == 0);
}

TEST_CASE("commands that do not share their work refuse to start as several processes", "[fast]") {
  const ValidationSetFolder made;
  for (const char* words : {"make --out new --kind drum --singles 1 --pairs 0 --none 0 --outside 0", "upper-bound set",
                            "follow-up set", "plan set", "loop set --hours 8"}) {
    INFO(words);
    const auto second = run_validation(words, made.folder.path(), "env OMPI_COMM_WORLD_RANK=1 OMPI_COMM_WORLD_SIZE=2");
    CHECK(second.status == 2);
    CHECK_THAT(flatten(second.err), Contains("2 processes were started, and each would do all of the work"));
  }
  CHECK(!fs::exists(made.folder.file("new")));
}

#ifdef ROLLRIG_MPIEXEC
TEST_CASE("under mpirun the processes share the sets, and one of them prints", "[slow]") {
  const ValidationSetFolder made;
  const std::string mpirun =  // Open MPI does not free all that it allocates
      "ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " ROLLRIG_MPIEXEC
      " --oversubscribe -n 2";
  const auto run = run_validation("run set --threads 1", made.folder.path(), mpirun);
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK(flatten(run.out) == "3 of 3 cases answered in set/answers/: 3 now, 0 before; 3 not diagnosed; 2 processes");
  CHECK(count_files(made.root + "/answers") == 3);
  CHECK_THAT(run_validation("run set", made.folder.path()).out, Contains("0 now, 3 before"));
}
#endif
