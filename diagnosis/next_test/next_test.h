#pragma once
/// Which test to run next: the one that is expected to tell most an hour.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/comparison/information.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/findings/open_questions.h"
#include "diagnosis/next_test/test_menu.h"

namespace rollrig::diagnosis {

/// A test of the menu, judged.
struct JudgedTest {
  PlannedTest test;
  double bits = 0.0;                       // expected fall of the entropy over the open hypotheses
  std::vector<std::string> splits;         // effects told from the likeliest hypotheses, or those from them
  bool splits_likeliest = false;           // tells two of the likeliest hypotheses apart
  std::vector<PredictedOutcome> outcomes;  // of each open hypothesis; empty where one cannot be simulated
};
std::vector<JudgedTest> judge_tests(const Study& study, const std::vector<OpenHypothesis>& open);

/// A test of the menu with what its files need; nothing is said of what it tells.
ProposedTest make_proposed_test(const PlannedTest& test);

/// The three tests that tell most an hour. Where the set leaves several causes equally likely, tests that tell any two
/// of those apart come before all others. None where nothing is open.
/// With a budget, tests that fit into its hours and that a set can hold, by the chance that they and the tests after
/// them bring the true cause to 95 % within the hours; of those within 2 % of the best, that which tells most an hour.
/// Source  docs/how_the_diagnosis_reasons.md, "How the next test is chosen"
/// Checked tests/diagnosis/next_test_test.cpp
std::vector<ProposedTest> propose_tests(const Study& study, const std::vector<OpenHypothesis>& open,
                                        const std::optional<TestBudget>& budget = std::nullopt);

/// Sensors that the rig could be given, by what they would add to an ordinary run (MeasurementKind::make_sensor_test)
/// in bits an hour of fitting them, the best first. Left out: those that add less than 0.01 bits.
/// Equation  bits = I(run with the sensor) - I(the same run without), I as calc_information_bits
/// Validity  as PredictedTest; I is a bound from below, and a difference of two bounds is an estimate
/// Checked   tests/diagnosis/next_test_test.cpp
std::vector<NextSensor> propose_sensors(const Study& study, const std::vector<OpenHypothesis>& open);

}  // namespace rollrig::diagnosis
