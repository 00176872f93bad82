// When a loop of tests has named a cause, and when it may end.
#include <catch2/catch.hpp>

#include "diagnosis/loop/test_loop.h"
#include "tests/diagnosis/hand_made.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

Diagnosis make_named(double probability, double alone) {
  Diagnosis made = tests::make_explained();
  made.causes.front().probability = probability;
  made.causes.front().alone = alone;
  return made;
}

}  // namespace

TEST_CASE("a cause at 95 % is named, and ends a loop once it acts alone at 90 %", "[fast]") {
  CHECK_FALSE(is_named(make_answer({}, make_named(0.94, 0.93))));
  CHECK(is_named(make_answer({}, make_named(0.98, 0.89))));
  CHECK_FALSE(is_settled(make_answer({}, make_named(0.98, 0.89))));
  CHECK(is_settled(make_answer({}, make_named(0.98, 0.91))));
  Diagnosis open = make_named(0.99, 0.95);
  open.causes.front().indistinguishable_from = {"windage"};
  CHECK_FALSE(is_named(make_answer({}, open)));
}

TEST_CASE("a trace at 95 % ends a loop: it is known, and does not matter", "[fast]") {
  Diagnosis made = tests::make_no_gap();
  CHECK_FALSE(is_settled(make_answer({}, made)));
  made.trace = tests::make_trace();
  CHECK_FALSE(is_named(make_answer({}, made)));  // 92 %
  made.trace->probability = 0.97;
  const LoopAnswer answer = make_answer({}, made);
  CHECK(answer.is_trace);
  CHECK(answer.effects == std::vector<std::string>{"torque_gain"});
  CHECK(is_settled(answer));
}

TEST_CASE("a loop without a further test ends with the cause that it has named", "[fast]") {
  LoopLedger ledger;
  ledger.hours = 8.0;
  ledger.answers = {make_answer(ledger, make_named(0.97, 0.6))};
  CHECK(find_end_without_test(ledger) == LoopState::kNamed);
  ledger.answers = {make_answer(ledger, make_named(0.9, 0.6))};
  CHECK(find_end_without_test(ledger) == LoopState::kNothingToTest);
}

TEST_CASE("a ledger keeps whether a cause acts alone, and whether it is a trace", "[fast]") {
  LoopLedger ledger;
  Diagnosis trace = tests::make_no_gap();
  trace.trace = tests::make_trace();
  ledger.answers = {make_answer(ledger, make_named(0.97, 0.6)), make_answer(ledger, trace)};
  Json json = make_ledger_json(ledger);
  CHECK(json["answers"][0]["alone"] == 0.6);
  CHECK(json["answers"][0]["is_trace"] == false);
  CHECK(json["answers"][1]["is_trace"] == true);
}
