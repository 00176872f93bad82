#pragma once
/// How likely tests are to name the cause that is true.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/comparison/information.h"

namespace rollrig::diagnosis {

/// Draws of what a test may measure, and how well each hypothesis predicts them.
class OutcomeDraws {
 public:
  /// `name` seeds the draws: those of tests with different names are independent.
  OutcomeDraws(const std::vector<PredictedOutcome>& outcomes, const std::string& name);

  /// ln p of each draw (row) by each hypothesis (column), where hypothesis `is_true` is true.
  const Eigen::MatrixXd& log_likelihoods(std::size_t is_true) const { return log_likelihoods_[is_true]; }
  std::size_t hypothesis_count() const { return log_likelihoods_.size(); }

 private:
  std::vector<Eigen::MatrixXd> log_likelihoods_;
};

/// A test that could be done, and the hours that it takes.
struct PossibleTest {
  double hours = 0.0;
  OutcomeDraws draws;
};

/// For each test: the chance that the true hypothesis has at least the probability `level` once that test is done and
/// those that tell most an hour after it, as long as they fit into the hours. 0 for a test that does not fit.
///
/// Equation  chance = sum_i w_i P(w_i p_i(x) / sum_j w_j p_j(x) >= level | i is true), x what all these tests measure
/// Symbols   w probabilities before the tests; p_i(x) product over the tests of the density that hypothesis i predicts
/// Validity  given a hypothesis, tests are independent: what one tells of the parameters does not help the next. Which
///           test follows does not wait for what the one before it measures. 64 seeded draws of each hypothesis
/// Checked   tests/diagnosis/naming_chance_test.cpp
std::vector<double> find_naming_chances(const std::vector<double>& probabilities,
                                        const std::vector<PossibleTest>& tests, double hours, double level);

}  // namespace rollrig::diagnosis
