#pragma once
/// Which test to run next: the one that is expected to tell most an hour.

#include <vector>

#include "diagnosis/comparison/information.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/findings/open_questions.h"
#include "diagnosis/next_test/test_menu.h"

namespace rollrig::diagnosis {

/// What each hypothesis predicts of a test: its runs simulated at the hypothesis's parameters, sensors' noise whitened
/// as in a diagnosis, one new session. Empty where a hypothesis cannot be simulated on it.
/// Equation  covariance = 1 + (J L)(J L)^T + offsets, L L^T what the parameters are uncertain by after the measurement,
///           all of it reduced to the directions in which the hypotheses' means and covariances differ from 1
/// Validity  linear in the parameters about the fit; model error as in the comparison, common to all hypotheses, in
///           proportion to what they differ by on average
/// Checked   tests/diagnosis/next_test_test.cpp
std::vector<PredictedOutcome> predict_outcomes(const PreparedSet& set,
                                               const std::vector<estimation::FreeParameter>& base,
                                               const std::vector<OpenHypothesis>& open, const PlannedTest& test);

/// A test of the menu, judged.
struct JudgedTest {
  PlannedTest test;
  double bits = 0.0;                // expected fall of the entropy over the open hypotheses
  std::vector<std::string> splits;  // effects told from the likeliest hypotheses, or those from them
  bool splits_likeliest = false;    // tells two of the likeliest hypotheses apart
};
std::vector<JudgedTest> judge_tests(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                    const std::vector<OpenHypothesis>& open, int threads);

/// The three tests that tell most an hour. Where the set leaves several causes equally likely, tests that tell any two
/// of those apart come before all others. None where nothing is open.
/// Source  design of the method, decision 9
/// Checked tests/diagnosis/next_test_test.cpp
std::vector<NextTest> propose_tests(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                    const std::vector<OpenHypothesis>& open, int threads);

/// Sensors that the rig could be given, by what they would add to an ordinary run (MeasurementKind::make_sensor_test)
/// in bits an hour of fitting them, the best first. Left out: those that add less than 0.01 bits.
/// Equation  bits = I(run with the sensor) - I(the same run without), I as calc_information_bits
/// Validity  as predict_outcomes; I is a bound from below, and a difference of two bounds is an estimate
/// Checked   tests/diagnosis/next_test_test.cpp
std::vector<NextSensor> propose_sensors(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                                        const std::vector<OpenHypothesis>& open);

}  // namespace rollrig::diagnosis
