// Loops of tests on cases whose truth is known, the generator as the rig.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

using namespace rollrig;
using nlohmann::json;
using tests::run_validation;

namespace {

/// Cases of one effect and without, on a drum, and their loops.
json loop_cases(const tests::TemporaryFolder& folder, const std::string& counts, const std::string& options) {
  const auto made = run_validation("make --kind drum --seed 9311 " + counts +
                                       " --pairs 0 --outside 0 --runs 3 --effects windage,torque_gain,load_exponent "
                                       "--out set",
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
