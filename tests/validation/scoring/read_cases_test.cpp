// What stands between a bank and its score: the seal, and answers to all sets.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "sim/core/error.h"
#include "tests/validation/scoring/bank_folder.h"
#include "validation/scoring/oracle.h"
#include "validation/scoring/run_bank.h"
#include "validation/scoring/score.h"

namespace fs = std::filesystem;
using Catch::Contains;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

proof::ScoreOrder make_order(const BankFolder& made) {
  proof::ScoreOrder order;
  order.bank = made.bank;
  order.answers = made.bank + "/answers";
  return order;
}

void answer_all(const BankFolder& made) {
  proof::run_bank({made.bank, made.bank + "/answers", proof::plan_race(made.bank, {}, {})});
}

}  // namespace

TEST_CASE("the truth opens with its own seal alone", "[fast]") {
  const BankFolder made;
  const auto truths = proof::open_truth(made.bank, "");
  REQUIRE(truths.size() == 3);
  CHECK(truths[0].effects.empty());
  CHECK(truths[1].name() == "rim_heat");
  CHECK_FALSE(truths[1].outside);
  CHECK(truths[2].outside);
  CHECK(proof::open_truth(made.bank, made.seal).size() == 3);
  CHECK_THROWS_WITH(proof::open_truth(made.bank, std::string(64, 'a')), Contains("the seal is broken"));
  write_file(made.truth, read_file(made.truth) + " ");  // a blank more is another file
  CHECK_THROWS_WITH(proof::open_truth(made.bank, ""), Contains("the seal is broken"));
}

TEST_CASE("the seal covers the files of the sets", "[fast]") {
  BankFolder made;
  Json json = Json::parse(read_file(made.truth));
  for (auto& [set, of] : json["sets"].items()) of["set_sha256"] = proof::hash_set(proof::set_folder(made.bank, set));
  made.write_truth(json.dump());
  CHECK(proof::open_truth(made.bank, "").size() == 3);
  write_file(made.bank + "/sets/0002/set.toml", "another set\n");
  answer_all(made);  // an answer to the edited files does not make them those that were sealed
  CHECK_THROWS_WITH(proof::open_truth(made.bank, ""), Contains("1 of 3 sets are not the files") && Contains("0002"));
}

TEST_CASE("a truth of other sets is not scored", "[fast]") {
  BankFolder made;
  Json json = Json::parse(read_file(made.truth));
  json["sets"].erase("0002");
  made.write_truth(json.dump());
  CHECK_THROWS_WITH(proof::open_truth(made.bank, ""), Contains("2 sets, the bank has 3"));
  made.write_truth("[]");
  CHECK_THROWS_AS(proof::open_truth(made.bank, ""), InputError);
}

TEST_CASE("answers that lack are counted, with the command that mends it", "[fast]") {
  const BankFolder made;
  answer_all(made);
  CHECK(proof::read_cases(make_order(made)).size() == 3);
  fs::remove(made.answer("0003"));
  CHECK_THROWS_WITH(proof::read_cases(make_order(made)),
                    Contains("1 of 3 sets") && Contains("rollrig blind run " + made.bank));
  answer_all(made);
  write_file(made.bank + "/sets/0001/set.toml", "changed after it was answered\n");
  CHECK_THROWS_WITH(proof::read_cases(make_order(made)), Contains("1 of 3 sets"));
}

TEST_CASE("races that know the truth are of effects of the catalog", "[fast]") {
  const BankFolder made;
  const auto truths = proof::open_truth(made.bank, "");
  const auto alone = proof::plan_oracle(truths, proof::OracleRace::kAlone, {});
  REQUIRE(alone.size() == 1);
  CHECK(alone[0].set == "0002");
  CHECK(alone[0].only == std::vector<std::string>{"rim_heat"});
  const auto left_out = proof::plan_oracle(truths, proof::OracleRace::kLeftOut, {"rim_heat", "windage"});
  REQUIRE(left_out.size() == 1);
  CHECK(left_out[0].only == std::vector<std::string>{"windage"});
  CHECK(left_out[0].without == std::vector<std::string>{"rim_heat"});
  const auto without_twins = proof::plan_oracle(truths, proof::OracleRace::kLeftOut,
                                                {"rim_heat", "windage", "slow_leak"}, {{"0002", {"windage"}}});
  CHECK(without_twins[0].only == std::vector<std::string>{"slow_leak"});
  CHECK(without_twins[0].without == std::vector<std::string>{"rim_heat", "windage"});
}

TEST_CASE("twins of a truth are what its own set could not tell from it, and no cause that misses it", "[fast]") {
  const BankFolder made;
  answer_all(made);
  const auto truths = proof::open_truth(made.bank, "");
  proof::Answer answer = proof::find_answer(made.bank + "/answers", "0002").value();
  answer.failure.clear();
  const auto say = [&](const std::vector<std::string>& effects, const std::vector<std::string>& others) {
    diagnosis::Cause cause;
    cause.effects = effects;
    cause.indistinguishable_from = others;
    answer.diagnosis.causes = {cause};
    proof::write_answer(made.bank + "/answers", answer);
    return proof::find_twins(truths, made.bank + "/answers");
  };
  CHECK(say({"windage"}, {"rim_heat", "slow_leak"}).at("0002") == std::vector<std::string>{"windage", "slow_leak"});
  CHECK(say({"rim_heat"}, {}).empty());
  CHECK(say({"windage"}, {"slow_leak"}).empty());
}

TEST_CASE("what the catalog calls confusable with a truth is left out with it, either way, where that is asked for",
          "[fast]") {
  const BankFolder made;
  const auto truths = proof::open_truth(made.bank, "");
  proof::Twins twins{{"0002", {"windage", "gas_heat_transfer"}}};  // of rim_heat
  proof::add_confusable(truths, twins);
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

TEST_CASE("a ceiling of another bank is refused, one of this bank read", "[fast]") {
  const BankFolder made;
  answer_all(made);
  proof::ScoreOrder order = make_order(made);
  order.ceiling = made.bank + "/ceiling.json";
  const auto write_ceiling = [&](const std::string& sha256) {
    const Json json = {{"truth_sha256", sha256},
                       {"sets",
                        {{"0002",
                          {{"d_prime", 7.5},
                           {"identifiable", true},
                           {"log_bayes_factors", {{"windage", 20.0}, {"slow_leak", 9.5}}}}}}}};
    write_file(order.ceiling, json.dump());
  };
  write_ceiling(std::string(64, '0'));
  CHECK_THROWS_AS(proof::read_cases(order), InputError);
  write_ceiling(made.seal);
  const std::vector<proof::Case> cases = proof::read_cases(order);
  CHECK(cases[1].d_prime == 7.5);
  CHECK(cases[1].log_bayes_factors == std::vector<double>{20.0, 9.5});
  CHECK_FALSE(cases[0].d_prime.has_value());
  CHECK(cases[0].log_bayes_factors.empty());
}
