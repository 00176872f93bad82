// rollrig_validation follow-up where plan or truth are not those of the case.
#include "tests/validation/generator/planned_case.h"

namespace fs = std::filesystem;
using Catch::Contains;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

/// The message of a plan that is no plan.
void check_refused(const PlannedCase& made, const std::vector<std::string>& words) {
  const ProgramResult ran = made.run();
  INFO(ran.err);
  CHECK(ran.status == 2);
  for (const std::string& word : words) CHECK_THAT(flatten(ran.err), Contains(word));
  CHECK_FALSE(fs::exists(made.root + "/followup/sets"));
}

}  // namespace

TEST_CASE("wrong plans are refused, with what is wrong and what is allowed", "[slow]") {
  const std::string order = "--effect none --seed 12 --runs 1";
  const PlannedCase empty(order);
  check_refused(empty, {"no plans in", "followup/plans", "first: rollrig_validation plan"});
  CHECK_THAT(empty.run(" --drawn").err,
             Contains("followup-drawn/plans") && Contains("plan " + empty.root + " --drawn"));

  const auto refuse = [&](const std::string& csv, const std::vector<std::string>& words) {
    PlannedCase made(order);
    made.add(csv);
    check_refused(made, words);
  };
  refuse("time_s,speed_km_h,ambient_degC\n0,80,24\n60,80,24\n",
         {"test-1.csv", "load_N", "given columns of a drum set"});
  refuse(std::string(kDrumHeader) + "0,80,5000\n", {"test-1.csv", "ragged"});
  refuse(std::string(kDrumHeader) + "0,80,5000,24\n60,fast,5000,24\n", {"test-1.csv", "speed_km_h", "fast"});
  refuse(std::string(kDrumHeader) + "0,80,5000,24\n60.5,80,5000,24\n", {"time_s", "60.5", "whole seconds"});
  refuse(std::string(kDrumHeader) + "0,80,-5,24\n60,80,5000,24\n", {"load_N", "-5", "0 or more"});
  refuse(std::string(kDrumHeader) + "0,80,5000,24\n60,80,5000,34\n", {"ambient_degC", "34", "one value"});

  const auto refuse_changed = [&](const char* key, const Json& value, const std::vector<std::string>& words) {
    PlannedCase made(order);
    made.plan[key] = value;
    made.add(kSteady);
    check_refused(made, words);
  };
  refuse_changed("format", "rollrig-run/1", {"plan.json", "format", "rollrig-blind-plan/1"});
  refuse_changed("kind", "road", {"plan.json", "kind", "drum"});
  refuse_changed("set_sha256", std::string(64, '0'), {"plan.json", "plan for other files", "set_sha256"});
  refuse_changed("set_sha256", 7, {"plan.json", "not a plan"});
}

TEST_CASE("a validation set that is not the plan's, or whose truth has another hash, is refused", "[fast]") {
  PlannedCase made("--effect none --seed 13 --runs 1");
  made.add(kSteady);
  fs::rename(made.plan_folder, made.root + "/followup/plans/0002");
  check_refused(made, {"plan for a case that the validation set has not", "0002"});
  fs::rename(made.root + "/followup/plans/0002", made.plan_folder);
  const std::string set_file = made.root + "/sets/0001/set.toml";
  write_file(set_file, read_file(set_file) + "\n");
  check_refused(made, {"sets/0001/set.toml", "is not what this program makes"});
  write_file(made.root + "/truth.json", read_file(made.root + "/truth.json") + " ");
  check_refused(made, {"truth.json is not the file that was made"});
}
