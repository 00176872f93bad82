// Runs of a validation set: resumed, blind to the truth, shared out.
#include "validation/scoring/run_cases.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "sim/core/error.h"
#include "tests/diagnosis/hand_made.h"
#include "tests/validation/scoring/validation_set_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

validation::RunOrder make_run_order(const ValidationSetFolder& made, const std::vector<std::string>& only = {}) {
  validation::RunOrder order{made.root, made.root + "/answers", validation::plan_tasks(made.root, only, {})};
  order.threads = 2;
  return order;
}

}  // namespace

TEST_CASE("each set has an answer, and a set that cannot be diagnosed an answer that says so", "[fast]") {
  const ValidationSetFolder made;
  const validation::AnswerTally tally = validation::run_cases(make_run_order(made));
  CHECK(tally.made == 3);
  CHECK(tally.failures.size() == 3);
  const auto answer = validation::find_answer(made.root + "/answers", "0002").value();
  CHECK(answer.failure.find("set.toml") != std::string::npos);
  CHECK(answer.set_sha256 == validation::hash_case(made.root + "/sets/0002"));
}

TEST_CASE("what is answered is kept, unless the case, the comparison or the file is another", "[slow]") {
  const ValidationSetFolder made;
  validation::run_cases(make_run_order(made));
  const std::string first = read_file(made.answer("0001"));
  CHECK(validation::run_cases(make_run_order(made)).kept == 3);
  CHECK(read_file(made.answer("0001")) == first);
  write_file(made.root + "/sets/0001/set.toml", "no set, other\n");
  fs::remove(made.answer("0002"));
  write_file(made.answer("0003"), "{\"format\": \"rollrig-blind-an");
  CHECK(validation::run_cases(make_run_order(made)).made == 3);
  write_file(made.root + "/sets/0001/run.csv", "");  // a file more is another set
  CHECK(validation::run_cases(make_run_order(made)).made == 1);
  CHECK(validation::run_cases(make_run_order(made, {"rim_heat"})).made == 3);
  CHECK(validation::run_cases(make_run_order(made, {"rim_heat"})).kept == 3);
}

TEST_CASE("an answer of another program is not kept", "[fast]") {
  const ValidationSetFolder made;
  validation::run_cases(make_run_order(made));
  validation::Answer answer = validation::find_answer(made.root + "/answers", "0001").value();
  answer.settings.program_sha256 = std::string(64, '0');
  validation::write_answer(made.root + "/answers", answer);
  CHECK(validation::run_cases(make_run_order(made)).made == 1);
}

TEST_CASE("the truth is not opened: without it, or where it is no file, the answers are the same", "[fast]") {
  const ValidationSetFolder made;
  validation::run_cases(make_run_order(made));
  const std::string blind = validation::find_answer(made.root + "/answers", "0002").value().failure;
  fs::remove(made.truth);
  fs::remove_all(made.root + "/answers");
  CHECK(validation::run_cases(make_run_order(made)).made == 3);
  fs::create_directory(made.truth);  // cannot be opened even by root
  fs::remove_all(made.root + "/answers");
  CHECK(validation::run_cases(make_run_order(made)).made == 3);
  CHECK(validation::find_answer(made.root + "/answers", "0002").value().failure == blind);
}

TEST_CASE("processes share the sets: each is answered by one", "[fast]") {
  const ValidationSetFolder made;
  validation::RunOrder order = make_run_order(made);
  order.part = {1, 2};
  const std::size_t first = order.part.count_of(3);
  CHECK(validation::run_cases(order).made == first);
  order.part = {2, 2};
  CHECK(validation::run_cases(order).made == 3 - first);
  order.part = {1, 1};
  CHECK(validation::run_cases(order).kept == 3);
}

TEST_CASE("an answer reads back as it was written", "[fast]") {
  for (const diagnosis::Diagnosis& of : {make_explained(), make_no_gap()}) {
    validation::Answer answer;
    answer.number = "0007";
    answer.set_sha256 = "ab";
    answer.settings = {"cd", {"rim_heat"}, {"windage"}};
    answer.seconds = 3.5;
    answer.diagnosis = of;
    const validation::Answer read = validation::read_answer_json(validation::make_answer_json(answer));
    CHECK(read.settings == answer.settings);
    CHECK(read.seconds == 3.5);
    CHECK(read.diagnosis.verdict == of.verdict);
    CHECK(read.diagnosis.probability == of.probability);
    CHECK(read.diagnosis.gap.shrink_percent == of.gap.shrink_percent);
    REQUIRE(read.diagnosis.causes.size() == of.causes.size());
    if (of.causes.empty()) continue;
    CHECK(read.diagnosis.causes.front().effects == of.causes.front().effects);
    CHECK(read.diagnosis.causes.front().parameters.back().high_95 == of.causes.front().parameters.back().high_95);
  }
}
