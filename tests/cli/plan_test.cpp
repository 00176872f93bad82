// rollrig plan: what it prints and writes, and what it refuses.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "build_paths.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;

TEST_CASE("a plan is printed, and written as JSON, as a page and as a folder whose runs can be carried out", "[fast]") {
  const TemporaryFolder folder;
  const std::string out = folder.file("campaign");
  const auto planned = run_program("plan --rig drum --hours 3 --only torque_gain,slow_leak --out " + out + " --json " +
                                   folder.file("plan.json") + " --html " + folder.file("plan.html"));
  REQUIRE(planned.status == 0);
  CHECK_THAT(planned.out, Contains("Campaign on drum_2m with tire a50") && Contains("of 2 effects would be visible"));
  const nlohmann::json plan = nlohmann::json::parse(read_file(folder.file("plan.json")));
  CHECK(plan["format"] == "rollrig-campaign/1");
  CHECK(plan["hours"].get<double>() <= 3.0);
  CHECK(plan["effects"].size() == 2);
  REQUIRE(!plan["tests"].empty());
  const Json& last_test = plan["tests"].back();
  CHECK(plan["visible"].get<int>() == last_test["visible"].get<int>());
  CHECK_THAT(read_file(folder.file("plan.html")), Contains("effects that have their usual size."));
  for (const char* file : {"plan.txt", "set.toml", "tire.toml", "rig.toml", "run-1.toml"}) {
    CHECK(!read_file(out + "/" + file).empty());
  }
  const auto run = run_program("run " + out + "/run-1.toml --write-set " + folder.file("set") + " --quiet");
  CHECK(run.status == 0);
  CHECK(run_program("plan --hours 3 --only torque_gain --out " + out).status == 2);  // it holds files
}

TEST_CASE("a plan for a machine, an effect or hours that cannot be is refused with what is allowed", "[slow]") {
  const struct {
    const char* arguments;
    const char* said;
  } refused[] = {{"--rig drun", "drum"},
                 {"--rig drum_3m", "drum_2m"},
                 {"--tire a55", "a50"},
                 {"--rig road --vehicle source_cat", "source_car"},
                 {"--sensors sorce", "source"},
                 {"--hours 0.2", "--hours"},
                 {"--hours 0.6", "no test of the machine fits"},
                 {"--hours soon", "--hours"},
                 {"--only slow_leek", "slow_leak"},
                 {"--only wind_and_grade", "on such a machine"}};
  for (const auto& [arguments, said] : refused) {
    INFO(arguments);
    const auto result = run_program(std::string("plan ") + arguments);
    CHECK(result.status == 2);
    CHECK_THAT(result.err, Contains(said));
    CHECK(result.out.empty());
  }
}
