// Loops of tests on cases whose truth is known, the generator as the rig.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

using namespace rollrig;
using nlohmann::json;
using tests::run_validation;

namespace {

/// Cases of one effect and without, on a drum, and their loops.
json loop_cases(const tests::TemporaryFolder& folder, const std::string& counts, const std::string& options,
                const std::string& effects = "windage,torque_gain,load_exponent") {
  const auto made = run_validation(
      "make --kind drum --seed 9311 " + counts + " --pairs 0 --outside 0 --runs 3 --out set --effects " + effects,
      folder.path());
  REQUIRE(made.status == 0);
  const auto looped = run_validation("loop set --quiet --json loops.json" + options, folder.path());
  INFO(looped.err);
  REQUIRE(looped.status == 0);
  return json::parse(tests::read_file(folder.file("loops.json")));
}

}  // namespace

TEST_CASE("loops stay within their hours, and what they name is judged by what is true", "[slow]") {
  const tests::TemporaryFolder folder;
  const json loops = loop_cases(folder, "--singles 1 --none 1", " --hours 3 --failing 0");
  REQUIRE(loops["cases"].size() == 2);
  for (const json& one : loops["cases"]) {
    INFO(one.dump(1));
    CHECK(one["failure"] == "");
    const json& loop = one["loop"];
    CHECK(loop["hours_used"].get<double>() <= 3.0);
    CHECK(loop["answers"].size() == loop["tests"].size() + 1);
    CHECK(loop["state"] != "waiting");
    const json& last = loop["answers"].back();
    const bool is_right = loop["state"] == "named" && last["effects"] == one["truth"];
    CHECK(one["right"].get<bool>() == is_right);
    if (loop["state"] == "named") CHECK(last["probability"].get<double>() >= 0.95);
  }
}

TEST_CASE("where every test fails, hours go and nothing is learned", "[slow]") {
  const tests::TemporaryFolder folder;
  const json loops = loop_cases(folder, "--singles 1 --none 0", " --hours 2 --failing 100");
  REQUIRE(loops["cases"].size() == 1);
  for (const json& one : loops["cases"]) {
    const json& answers = one["loop"]["answers"];
    for (const json& answer : answers) CHECK(answer["probability"] == answers[0]["probability"]);
    REQUIRE(!one["loop"]["tests"].empty());
    for (const json& test : one["loop"]["tests"]) CHECK(test["state"] == "failed");
  }
}

TEST_CASE("a fixed campaign does not depend on what is measured", "[weekly]") {
  std::vector<std::vector<std::string>> done;
  for (const std::string effect : {"windage", "load_exponent"}) {  // on the same machine, by the same seed
    const tests::TemporaryFolder folder;
    const json loops =
        loop_cases(folder, "--singles 1 --none 0", " --hours 2.5 --failing 0 --tests fixed --ideal", effect);
    CHECK(loops["tests"] == "fixed");
    REQUIRE(loops["cases"].size() == 1);
    const json& one = loops["cases"][0];
    INFO(one.dump(1));
    CHECK(one["failure"] == "");
    CHECK(one["separable"].size() == one["loop"]["answers"].size());
    done.emplace_back();
    for (const json& test : one["loop"]["tests"]) done.back().push_back(test["id"]);
  }
  const std::size_t both = std::min(done[0].size(), done[1].size());  // a loop ends when its cause is named
  CAPTURE(done);
  REQUIRE(both > 0);
  done[0].resize(both);
  done[1].resize(both);
  CHECK(done[0] == done[1]);
}

TEST_CASE("an unknown choice of tests is told, with those that there are", "[fast]") {
  const tests::TemporaryFolder folder;
  const auto looped = run_validation("loop set --tests best --json loops.json", folder.path());
  CHECK(looped.status == 2);
  CHECK_THAT(looped.err, Catch::Contains("'best'") && Catch::Contains("proposed, drawn, fixed"));
}

TEST_CASE("hours that no machine has are refused before anything is simulated", "[fast]") {
  const tests::TemporaryFolder folder;
  for (const std::string hours : {"-1", "0", "nan", "inf", "1e300"}) {
    INFO(hours);
    const auto looped = run_validation("loop set --tests fixed --json loops.json --hours " + hours, folder.path());
    CHECK(looped.status == 2);
    CHECK_THAT(looped.err, Catch::Contains("--hours"));
  }
}
