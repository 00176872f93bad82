// The page of a loop: its ledger as steps.
#include <catch2/catch.hpp>

#include "report/diagnosis_page.h"

using namespace rollrig;

TEST_CASE("the ledger of a loop is a step for each answer, to the hours that are used", "[fast]") {
  LoopLedger ledger;
  ledger.hours = 8.0;
  ledger.tests = {{"skim_sweep", "a skim sweep", 1.5, 0.4, 0.35, {}, {}, LoopTestState::kMeasured},
                  {"load_sweep", "a load sweep", 2.0, 0.3, 0.6, {}, {}, LoopTestState::kFailed}};
  LoopAnswer first;
  first.effects = {"slip"};
  first.probability = 0.4;
  first.none = 0.1;
  first.unknown = 0.05;
  LoopAnswer second = first;
  second.tests = 1;
  second.hours = 1.5;
  second.effects = {"bearing_warmup"};
  second.probability = 0.97;
  ledger.answers = {first, second};
  const report::Section section = report::make_loop_section(ledger);
  REQUIRE(section.blocks.size() == 2);
  const Json& cause = section.blocks[0]["series"][0];
  CHECK(cause["kind"] == "steps");
  CHECK(cause["x"] == Json({0.0, 1.5, 3.5}));  // the failed test took its hours
  CHECK(cause["y"] == Json({40.0, 97.0, 97.0}));
  CHECK(section.blocks[0]["series"][2]["y"][0] == 5.0);
  CHECK(section.blocks[1]["rows"][1][2] == "bearing warmup");
  CHECK(report::make_loop_section(LoopLedger()).blocks.empty());
}

TEST_CASE("the first screen of a loop says hours, tests and what comes next", "[fast]") {
  LoopLedger ledger;
  ledger.hours = 8.0;
  ledger.tests = {{"skim_sweep", "a skim sweep", 1.5, 0.4, 0.35, {}, {}, LoopTestState::kMeasured},
                  {"load_sweep", "a load sweep", 2.0, 0.3, 0.6, {}, {}, LoopTestState::kPlanned}};
  ledger.answers = {LoopAnswer()};
  const auto make_page = [&ledger] {
    report::Page page{"loop", "Diagnosis", ""};
    page.add({"Verdict",
              "",
              {{{"type", "lead"}, {"text", "Explained."}},
               {{"type", "tiles"}, {"tiles", {{{"label", "Cause"}}, {{"label", "How sure"}}}}}}});
    report::add_loop(ledger, page);
    return page;
  };
  const report::Page waiting = make_page();
  CHECK(waiting.sections[0].blocks[0]["more"] ==
        "Loop of tests: 1 test done, 1.5 of 8.0 h of the machine used. Next: test-2, a load sweep (2.0 h).");
  CHECK(waiting.sections[0].blocks[1]["tiles"][1]["value"] == "1.5 of 8.0");
  CHECK(waiting.sections[1].blocks[0]["type"] == "curves");
  ledger.tests.back().state = LoopTestState::kFailed;
  ledger.state = LoopState::kNamed;
  const std::string ended = make_page().sections[0].blocks[0]["more"];
  CHECK(ended ==
        "Loop of tests: 1 test done, 1 failed, 3.5 of 8.0 h of the machine used. A cause has at least 95 %: no further "
        "test is needed.");
}
