// A blind bank of ten sets, made, diagnosed and scored as users do it, against what it gave when it was last looked at.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "sim/core/file_io.h"
#include "tests/support/run_program.h"

using nlohmann::json;
using namespace rollrig::tests;

namespace {

/// Verdict and first cause of each set, and all counts of the score.
json summarize(const std::string& bank, const json& score) {
  json now = {{"seal", rollrig::read_text_file(bank + "/seal.sha256").substr(0, 64)}};
  for (const json& figure : score["figures"]) {
    if (figure["n"] > 0) now["figures"][figure["id"].get<std::string>()] = {figure["k"], figure["n"]};
  }
  const json truth = json::parse(read_file(bank + "/truth.json"));
  for (const auto& [set, of] : truth["sets"].items()) {
    const json answer = json::parse(read_file(bank + "/answers/" + set + ".json"));
    const json& causes = answer["diagnosis"]["causes"];
    now["sets"][set] = {{"verdict", answer["diagnosis"]["verdict"]},
                        {"first", causes.empty() ? json::array() : causes[0]["effects"]}};
  }
  return now;
}

}  // namespace

TEST_CASE("a blind bank of ten sets comes out as it did", "[slow]") {
  const TemporaryFolder folder;
  const std::string stored_file = ROLLRIG_SOURCE_DIR "/tests/validation/scoring/regression_bank.json";
  const json stored = json::parse(read_file(stored_file));
  const auto made = run_program(
      "blind make --seed 6010 --out bank --kind mixed --singles 6 --pairs 1 --none 2 --outside 1", folder.path());
  INFO(made.err);
  REQUIRE(made.status == 0);
  const auto answered = run_program("blind run bank --quiet", folder.path());
  INFO(answered.err);
  REQUIRE(answered.status == 0);
  const auto scored = run_program("blind score bank --json score.json --quiet", folder.path());
  INFO(scored.err);
  REQUIRE(scored.status == 0);
  const json now = summarize(folder.file("bank"), json::parse(read_file(folder.file("score.json"))));
  INFO("if that is meant: " << stored_file << " is to hold\n" << now.dump(1));
  CHECK(now["seal"] == stored["seal"]);  // the generator makes the same sets
  CHECK(now["sets"] == stored["sets"]);
  CHECK(now["figures"] == stored["figures"]);
}
