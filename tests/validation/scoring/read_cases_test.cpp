// What stands between a validation set and its score: the hash of its truth, and answers to all cases.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "sim/core/error.h"
#include "tests/validation/scoring/validation_set_folder.h"
#include "validation/scoring/run_cases.h"
#include "validation/scoring/score.h"

namespace fs = std::filesystem;
using Catch::Contains;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

validation::ScoreOrder make_score_order(const ValidationSetFolder& made) {
  validation::ScoreOrder order;
  order.set = made.root;
  order.answers = made.root + "/answers";
  return order;
}

void answer_all(const ValidationSetFolder& made) {
  validation::run_cases({made.root, made.root + "/answers", validation::plan_tasks(made.root, {}, {})});
}

}  // namespace

TEST_CASE("the truth opens with its own hash alone", "[fast]") {
  const ValidationSetFolder made;
  const auto truths = validation::read_truths(made.root, "");
  REQUIRE(truths.size() == 3);
  CHECK(truths[0].effects.empty());
  CHECK(truths[1].name() == "rim_heat");
  CHECK_FALSE(truths[1].outside);
  CHECK(truths[2].outside);
  CHECK(validation::read_truths(made.root, made.hash).size() == 3);
  CHECK_THROWS_WITH(validation::read_truths(made.root, std::string(64, 'a')), Contains("another hash"));
  write_file(made.truth, read_file(made.truth) + " ");  // a blank more is another file
  CHECK_THROWS_WITH(validation::read_truths(made.root, ""), Contains("another hash"));
}

TEST_CASE("the truth covers the files of the cases", "[fast]") {
  ValidationSetFolder made;
  Json json = Json::parse(read_file(made.truth));
  for (auto& [set, of] : json["sets"].items())
    of["set_sha256"] = validation::hash_case(validation::case_folder(made.root, set));
  made.write_truth(json.dump());
  CHECK(validation::read_truths(made.root, "").size() == 3);
  write_file(made.root + "/sets/0002/set.toml", "another set\n");
  answer_all(made);  // an answer to the edited files does not make them those that were made
  CHECK_THROWS_WITH(validation::read_truths(made.root, ""),
                    Contains("1 of 3 cases are not the files") && Contains("0002"));
}

TEST_CASE("a truth of other cases is not scored", "[fast]") {
  ValidationSetFolder made;
  Json json = Json::parse(read_file(made.truth));
  json["sets"].erase("0002");
  made.write_truth(json.dump());
  CHECK_THROWS_WITH(validation::read_truths(made.root, ""), Contains("2 cases, the validation set has 3"));
  made.write_truth("[]");
  CHECK_THROWS_AS(validation::read_truths(made.root, ""), InputError);
}

TEST_CASE("answers that lack are counted, with the command that mends it", "[fast]") {
  const ValidationSetFolder made;
  answer_all(made);
  CHECK(validation::read_cases(make_score_order(made)).size() == 3);
  fs::remove(made.answer("0003"));
  CHECK_THROWS_WITH(validation::read_cases(make_score_order(made)),
                    Contains("1 of 3 cases") && Contains("rollrig_validation run " + made.root));
  answer_all(made);
  write_file(made.root + "/sets/0001/set.toml", "changed after it was answered\n");
  CHECK_THROWS_WITH(validation::read_cases(make_score_order(made)), Contains("1 of 3 cases"));
}

TEST_CASE("fits that know the cause are of effects of the catalog", "[fast]") {
  const ValidationSetFolder made;
  const auto truths = validation::read_truths(made.root, "");
  const auto alone = validation::plan_known_cause(truths, validation::KnownCause::kAlone, {});
  REQUIRE(alone.size() == 1);
  CHECK(alone[0].number == "0002");
  CHECK(alone[0].only == std::vector<std::string>{"rim_heat"});
  const auto left_out = validation::plan_known_cause(truths, validation::KnownCause::kLeftOut, {"rim_heat", "windage"});
  REQUIRE(left_out.size() == 1);
  CHECK(left_out[0].only == std::vector<std::string>{"windage"});
  CHECK(left_out[0].without == std::vector<std::string>{"rim_heat"});
  const auto without_twins = validation::plan_known_cause(
      truths, validation::KnownCause::kLeftOut, {"rim_heat", "windage", "slow_leak"}, {{"0002", {"windage"}}});
  CHECK(without_twins[0].only == std::vector<std::string>{"slow_leak"});
  CHECK(without_twins[0].without == std::vector<std::string>{"rim_heat", "windage"});
}

TEST_CASE("with the truth left out, those cases are scored that a fit with known cause answers", "[fast]") {
  const ValidationSetFolder made;
  validation::ScoreOrder order = make_score_order(made);
  order.answers = made.root + "/answers-left-out";
  order.truth_was_left_out = true;
  const auto truths = validation::read_truths(made.root, "");
  validation::run_cases(
      {made.root, order.answers,
       validation::plan_known_cause(truths, validation::KnownCause::kLeftOut, {"rim_heat", "windage"})});
  const auto cases = validation::read_cases(order);
  REQUIRE(cases.size() == 1);
  CHECK(cases[0].truth.number == "0002");
}

TEST_CASE("twins of a truth are what its own set could not tell from it, and no cause that misses it", "[fast]") {
  const ValidationSetFolder made;
  answer_all(made);
  const auto truths = validation::read_truths(made.root, "");
  validation::Answer answer = validation::find_answer(made.root + "/answers", "0002").value();
  answer.failure.clear();
  const auto say = [&](const std::vector<std::string>& effects, const std::vector<std::string>& others) {
    diagnosis::Cause cause;
    cause.effects = effects;
    cause.indistinguishable_from = others;
    answer.diagnosis.causes = {cause};
    validation::write_answer(made.root + "/answers", answer);
    return validation::find_twins(truths, made.root + "/answers");
  };
  CHECK(say({"windage"}, {"rim_heat", "slow_leak"}).at("0002") == std::vector<std::string>{"windage", "slow_leak"});
  CHECK(say({"rim_heat"}, {}).empty());
  CHECK(say({"windage"}, {"slow_leak"}).empty());
}

TEST_CASE("what the catalog calls confusable with a truth is left out with it, either way, where that is asked for",
          "[fast]") {
  const ValidationSetFolder made;
  const auto truths = validation::read_truths(made.root, "");
  validation::Twins twins{{"0002", {"windage", "gas_heat_transfer"}}};  // of rim_heat
  validation::add_confusable(truths, twins);
  auto& of_set = twins.at("0002");
  const auto count = [&of_set](const char* id) { return std::count(of_set.begin(), of_set.end(), id); };
  CHECK(count("cell_air_warming") == 1);   // says it of rim_heat, and rim_heat of it
  CHECK(count("brake_heat") == 1);         // says it of rim_heat alone
  CHECK(count("gas_heat_transfer") == 1);  // known already
  CHECK(count("windage") == 1);
  CHECK(count("rim_heat") == 0);
  CHECK(count("clock_shift") == 0);
  CHECK(twins.count("0001") == 0);  // no effect
  CHECK(twins.count("0003") == 0);  // outside of the catalog
}

TEST_CASE("an upper bound of another validation set is refused, one of this validation set read", "[fast]") {
  const ValidationSetFolder made;
  answer_all(made);
  validation::ScoreOrder order = make_score_order(made);
  order.upper_bound = made.root + "/upper_bound.json";
  const auto write_bound = [&](const std::string& sha256) {
    const Json json = {{"truth_sha256", sha256},
                       {"sets",
                        {{"0002",
                          {{"d_prime", 7.5},
                           {"identifiable", true},
                           {"log_bayes_factors", {{"windage", 20.0}, {"slow_leak", 9.5}}}}}}}};
    write_file(order.upper_bound, json.dump());
  };
  write_bound(std::string(64, '0'));
  CHECK_THROWS_AS(validation::read_cases(order), InputError);
  write_bound(made.hash);
  const std::vector<validation::Case> cases = validation::read_cases(order);
  CHECK(cases[1].d_prime == 7.5);
  CHECK(cases[1].log_bayes_factors == std::vector<double>{20.0, 9.5});
  CHECK_FALSE(cases[0].d_prime.has_value());
  CHECK(cases[0].log_bayes_factors.empty());
}
