// From an answer that leaves causes open to the test that is to split them, and to what the score makes of it.
#include "validation/scoring/follow_up.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "sim/core/error.h"
#include "tests/support/run_program.h"
#include "tests/validation/scoring/hand_made_cases.h"
#include "tests/validation/scoring/validation_set_folder.h"
#include "validation/scoring/report.h"

namespace fs = std::filesystem;
using Catch::Contains;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

constexpr const char* kStandstill = "torque at standstill, tire lifted, for 5 min before and after 40 min at 80 km/h";
constexpr const char* kPulse = "speed steps 80, 120, 40, 120 km/h with a common electrical pulse on both loggers";
constexpr const char* kReversedSteps =
    "the same load steps forwards and in reversed rotation, 80 km/h, on the warm tire";

/// A validation set of `sets` short drum sets, each answered by hand.
struct OpenSet {
  TemporaryFolder folder;
  std::string root = folder.file("set");
  std::string answers = root + "/answers";

  explicit OpenSet(int sets) {
    const auto made =
        run_validation("make --kind drum --singles 0 --pairs 0 --outside 0 --effects torque_zero_drift --each " +
                       std::to_string(sets) + " --none 0 --runs 2 --seed 31 --out " + root);
    INFO(made.err);
    REQUIRE(made.status == 0);
    fs::create_directory(answers);
  }

  /// The answer to a set: the drift or windage, and what is proposed then.
  validation::Answer answer(const std::string& set, const std::vector<std::string>& proposed) const {
    validation::Case one = say_cause(make_case(set, {}), {"torque_zero_drift"}, 0.95, {"windage"});
    one.answer.set_sha256 = validation::hash_case(validation::case_folder(root, set));
    for (const std::string& test : proposed) one.answer.diagnosis.next_tests.push_back({test, {"windage"}, 0.5, 2.0});
    validation::write_answer(answers, one.answer);
    return one.answer;
  }

  /// The truth is no file: what opens it fails.
  void hide_truth() const {
    fs::remove(root + "/truth.json");
    fs::create_directory(root + "/truth.json");
  }

  validation::PlanOrder order(validation::Choice choice = validation::Choice::kProposed, std::uint64_t seed = 1) const {
    validation::PlanOrder made{root, answers, choice};
    made.seed = seed;
    return made;
  }
  std::string plan_file(const std::string& set) const { return root + "/followup/plans/" + set + "/plan.json"; }
};

validation::Case case_of(const std::string& set, const validation::Answer& answer) {
  validation::Case one = make_case(set, {"torque_zero_drift"});
  one.answer = answer;
  return one;
}

/// What a case's next test left of the named set, and how that is judged.
std::string find_outcome(const validation::Score& score, const validation::Case& one) {
  const Table table = validation::make_follow_up_tables(score).front();
  for (const auto& row : table.rows) {
    if (row.front() == one.truth.number + " " + one.truth.campaign) return row[4] + ": " + row.back();
  }
  return "";
}

const validation::Figure& find_figure(const validation::Score& score, const std::string& id) {
  return *std::find_if(score.figures.begin(), score.figures.end(), [&](const auto& one) { return one.id == id; });
}

/// A case whose test was done, after which `named` are named.
validation::Case follow(validation::Case one, const std::vector<std::string>& named) {
  const validation::Case after =
      say_cause(make_case(one.truth.number, {}), {named.front()}, 0.97, {named.begin() + 1, named.end()});
  one.next_test = validation::FollowUp{{one.truth.number, "", one.named_set(), "a test", ""}, after.answer};
  return one;
}

}  // namespace

TEST_CASE("plans are made of the proposed tests, the truth unopened", "[fast]") {
  const OpenSet made(3);
  made.hide_truth();
  made.answer("0001", {kStandstill, kPulse});
  made.answer("0002", {kPulse});
  made.answer("0003", {});
  const auto plans = validation::plan_follow_ups(made.order());
  REQUIRE(plans.size() == 3);
  CHECK(plans[0].not_made.empty());
  CHECK(plans[0].named == std::vector<std::string>{"torque_zero_drift", "windage"});
  CHECK_THAT(plans[1].not_made, Contains("a common pulse"));
  CHECK_THAT(plans[2].not_made, Contains("no test is proposed"));
  CHECK_FALSE(fs::exists(made.plan_file("0002")));
  const Json plan = Json::parse(read_file(made.plan_file("0001")));
  CHECK(plan["kind"] == "drum");
  CHECK(plan["set_sha256"] == validation::hash_case(validation::case_folder(made.root, "0001")));
  CHECK(plan["by_hand"].size() == 1);
  const Json& run = plan["runs"][0];
  CHECK(run["force_at_standstill"] == true);
  // 5 min at standstill, up to 80 km/h in 80 s and 40 min there, which are not read, then down and at standstill again.
  CHECK(run["not_read_s"] == Json({{300.0, 2780.0}}));
  CHECK_THAT(read_file(made.root + "/followup/plans/0001/" + run["file"].get<std::string>()),
             Contains("time_s,speed_km_h,load_N,ambient_degC\n0,0,0,"));
}

TEST_CASE("a plan says which run is reversed", "[fast]") {
  const OpenSet made(1);
  made.answer("0001", {kReversedSteps});
  REQUIRE(validation::plan_follow_ups(made.order()).front().not_made.empty());
  const Json plan = Json::parse(read_file(made.plan_file("0001")));
  REQUIRE(plan["runs"].size() == 2);
  CHECK(plan["runs"][0]["reversed"] == false);
  CHECK(plan["runs"][1]["reversed"] == true);
  CHECK(plan["runs"][0]["not_read_s"] == Json({{0.0, 1800.0}}));
}

TEST_CASE("an answer that leaves nothing open has no plan", "[fast]") {
  const OpenSet made(2);
  made.answer("0001", {kStandstill});
  validation::Answer alone = made.answer("0002", {kStandstill});
  alone.diagnosis.causes.front().indistinguishable_from.clear();
  validation::write_answer(made.answers, alone);
  CHECK(validation::plan_follow_ups(made.order()).size() == 1);
}

TEST_CASE("a drawn test is one of the menu that can be made, by the seed", "[slow]") {
  const OpenSet made(8);
  for (const std::string& set : validation::list_cases(made.root)) made.answer(set, {});
  const auto draw = [&](std::uint64_t seed) {
    fs::remove_all(made.root + "/followup-drawn");
    std::vector<std::string> tests;
    for (const auto& plan : validation::plan_follow_ups(made.order(validation::Choice::kDrawn, seed))) {
      CHECK(plan.not_made.empty());
      tests.push_back(plan.test);
    }
    return tests;
  };
  const auto first = draw(1);
  CHECK(std::set<std::string>(first.begin(), first.end()).size() > 2);
  CHECK(draw(1) == first);
  CHECK(draw(2) != first);
}

TEST_CASE("what stands in the way of plans is said, and nothing is written", "[fast]") {
  const OpenSet made(2);
  made.answer("0001", {kStandstill});
  CHECK_THROWS_WITH(validation::plan_follow_ups(made.order()),
                    Contains("1 of 2 cases") && Contains("rollrig_validation run"));
  made.answer("0002", {"a test that there is not"});
  CHECK_THROWS_WITH(validation::plan_follow_ups(made.order()),
                    Contains("0002.json") && Contains("a test that there is not"));
  CHECK_FALSE(fs::exists(made.root + "/followup"));
  made.answer("0002", {kStandstill});
  validation::plan_follow_ups(made.order());
  CHECK_THROWS_WITH(validation::plan_follow_ups(made.order()), Contains("is there already"));
}

TEST_CASE("planned, done and answered tests come to the cases, and what lacks is said", "[fast]") {
  const OpenSet made(2);
  const std::string folder = made.root + "/followup";
  std::vector<validation::Case> cases{case_of("0001", made.answer("0001", {kStandstill})),
                                      case_of("0002", made.answer("0002", {kPulse}))};
  validation::plan_follow_ups(made.order());
  const auto read = [&] { validation::read_follow_ups(made.root, validation::Choice::kProposed, folder, cases); };
  CHECK_THROWS_WITH(read(), Contains("1 cases have no answer") && Contains("rollrig_validation follow-up"));
  const auto done = run_validation("follow-up " + made.root);
  INFO(done.err);
  REQUIRE(done.status == 0);
  CHECK_THROWS_AS(read(), InputError);
  validation::Answer after = cases[0].answer;
  after.set_sha256 = validation::hash_case(validation::case_folder(folder, "0001"));
  after.diagnosis.causes.front().indistinguishable_from.clear();
  fs::create_directory(folder + "/answers");
  validation::write_answer(folder + "/answers", after);
  read();
  REQUIRE(cases[0].next_test.has_value());
  CHECK(cases[0].is_split_by(*cases[0].next_test));
  REQUIRE(cases[1].next_test.has_value());
  CHECK_FALSE(cases[1].next_test->answer.has_value());
  CHECK_THAT(find_outcome(validation::score_cases(cases, {}), cases[1]), Contains("not made, a common pulse"));
  cases[0].answer.diagnosis.causes.front().indistinguishable_from = {"torque_gain"};  // another answer by now
  CHECK_THROWS_WITH(read(), Contains("no plans for the answer to case 0001") && Contains("rollrig_validation plan"));
}

TEST_CASE("a test splits where fewer are named with its runs, and the truth among them", "[fast]") {
  const auto before = [](const std::string& set, const std::vector<std::string>& truth) {
    return say_cause(make_case(set, truth), {"windage"}, 0.9, {"torque_gain", "rim_heat"});
  };
  std::vector<validation::Case> cases{
      follow(before("1", {"torque_gain"}), {"torque_gain"}),                         // split
      follow(before("2", {"torque_gain"}), {"torque_gain", "windage"}),              // split, two left of three
      follow(before("3", {"torque_gain"}), {"windage", "torque_gain", "rim_heat"}),  // not smaller
      follow(before("4", {"torque_gain"}), {"windage"}),                             // lost
      follow(before("5", {}), {"windage"}),                                          // a false alarm: not counted
      before("6", {"torque_gain"})};                                                 // not followed up
  cases[5].next_test = validation::FollowUp{{"6", "", cases[5].named_set(), "a test", "weights"}, {}};
  cases.push_back(follow(before("7", {"torque_gain"}), {"torque_gain"}));
  cases.back().next_test->answer = say_unexplained(cases.back()).answer;  // by now unexplained
  for (validation::Case& one : cases) one.answer.diagnosis.next_tests = {{"a test", {"torque_gain"}, 0.5, 2.0}};
  cases[2].answer.diagnosis.next_tests = {{"a test", {"windage", "torque_gain"}, 0.5, 2.0}};
  const validation::Score score = validation::score_cases(cases, {});
  const validation::Figure& figure = find_figure(score, "next_test");
  CHECK(figure.n == 5);
  CHECK(figure.k == 2);
  CHECK(figure.interval->low == Approx(validation::calc_wilson_95(2, 5).low));
  const validation::Figure& promised = find_figure(score, "promised_test");  // of the one that says so
  CHECK(promised.n == 1);
  CHECK(promised.k == 0);
  CHECK(find_figure(score, "drawn_test").note == "not measured: rollrig_validation plan --drawn");
  CHECK(score.followed_up.size() == 7);
  CHECK_THAT(validation::make_follow_up_tables(score).front().title,
             Contains("7 cases whose cause") && Contains("6 followed up"));
  const auto says = [&](std::size_t i) { return find_outcome(score, cases[i]); };
  CHECK(says(1) == "torque_gain, windage: split");
  CHECK_THAT(says(2), Contains("not smaller"));
  CHECK_THAT(says(3), Contains("windage: the truth lost"));
  CHECK_THAT(says(5), Contains("not made, weights"));
  CHECK_THAT(says(6), Contains(": unexplained"));
  CHECK(validation::make_score_json(score)["next_tests"][3]["next_test"]["outcome"] == "the truth lost");
  CHECK_THAT(validation::format_score_markdown(score), Contains("| 1 full_drum | torque_gain |"));
}

TEST_CASE("a validation set that was not followed up has no figure, and says how to get it", "[fast]") {
  const validation::Score score =
      validation::score_cases({say_cause(make_case("1", {"rim_heat"}), {"rim_heat"}, 0.9, {"windage"})}, {});
  CHECK_FALSE(find_figure(score, "next_test").value.has_value());
  CHECK_THAT(find_figure(score, "next_test").note, Contains("rollrig_validation plan"));
}
