#include "validation/scoring/machine_pairs.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using validation::judge_pair;
using validation::PairTruth;

namespace {

PairFindings answer_with(std::vector<std::string> effects, std::vector<std::string> beside, double on_a, double on_b) {
  PairFindings answer;
  answer.verdict = PairVerdict::kExplained;
  MachineDifference cause;
  cause.on_machine = {{effects.front(), {on_a, on_b}}};
  cause.effects = std::move(effects);
  cause.indistinguishable_from = std::move(beside);
  cause.probability = on_a + on_b;
  answer.causes = {cause};
  return answer;
}

}  // namespace

TEST_CASE("a pair is right if its effect is among three that are named, and first if it alone is the cause", "[fast]") {
  const PairTruth truth{"load_record", 1, false, 9.0};
  const auto first = judge_pair(answer_with({"load_record"}, {"surface_roughness"}, 0.1, 0.8), truth);
  CHECK(first.is_named);
  CHECK(first.is_top);
  CHECK(first.is_right_machine);
  const auto beside = judge_pair(answer_with({"surface_roughness"}, {"load_record"}, 0.1, 0.8), truth);
  CHECK(beside.is_named);
  CHECK_FALSE(beside.is_top);
  const auto other_machine = judge_pair(answer_with({"load_record"}, {}, 0.8, 0.1), truth);
  CHECK(other_machine.is_named);
  CHECK_FALSE(other_machine.is_right_machine);
  CHECK_FALSE(judge_pair(answer_with({"a"}, {"b", "c", "load_record"}, 0.5, 0.5), truth).is_named);
  CHECK_FALSE(judge_pair(answer_with({"torque_gain"}, {}, 0.5, 0.5), truth).is_named);
  PairFindings agrees = answer_with({"load_record"}, {}, 0.1, 0.1);
  agrees.verdict = PairVerdict::kAgree;
  CHECK_FALSE(judge_pair(agrees, truth).is_any_named);
  CHECK_FALSE(judge_pair(agrees, truth).is_named);
}

TEST_CASE("pairs are made, compared and scored by three commands, and a run goes on where it stopped", "[slow]") {
  const tests::TemporaryFolder folder;
  const std::string set = folder.file("pairs");
  REQUIRE(tests::run_validation("make-pairs --seed 4 --differing 3 --none 1 --runs 2 --out " + set).status == 0);
  const auto early = tests::run_validation("score-pairs " + set);
  CHECK(early.status == 2);
  CHECK_THAT(early.err, Catch::Contains("4 of 4 cases have no answer") && Catch::Contains("run-pairs"));
  const auto answered = tests::run_validation("run-pairs " + set);
  REQUIRE(answered.status == 0);
  CHECK_THAT(answered.out, Catch::Contains("4 now, 0 before"));
  std::filesystem::remove(set + "/answers/0002.json");
  CHECK_THAT(tests::run_validation("run-pairs " + set).out, Catch::Contains("1 now, 3 before"));
  REQUIRE(tests::run_validation("score-pairs " + set + " --json " + folder.file("score.json")).status == 0);
  const Json score = read_json(folder.file("score.json"));
  CHECK(score.at("format") == "rollrig-validation-pair-score/1");
  for (const Json& share : score.at("shares")) {
    CHECK(share.at("right").get<int>() <= share.at("cases").get<int>());
    const std::string label = share.at("label").get<std::string>();
    if (label.find("nothing is named") != std::string::npos) CHECK(share.at("right") == share.at("cases"));
  }
}
