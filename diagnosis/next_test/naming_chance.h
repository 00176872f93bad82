#pragma once
/// The chance that tests name the true cause: that the probability of the true hypothesis reaches a level.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/comparison/information.h"

namespace rollrig::diagnosis {

/// Random outcomes of a test, drawn under each hypothesis, and the likelihood of each under all hypotheses.
class OutcomeDraws {
 public:
  /// `name` seeds the draws: those of tests with different names are independent.
  OutcomeDraws(const std::vector<PredictedOutcome>& outcomes, const std::string& name);

  /// ln p of each draw (row) under each hypothesis (column); the draws are those under hypothesis `is_true`.
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

/// For each test: the chance that the true hypothesis has at least the probability `level` after this test and the
/// tests that follow it. They are added one by one: each time the one that raises the expected logarithm of the
/// probability of the true hypothesis most per hour, until no test fits into the hours or helps, or the chance is above
/// 0.999. The chance is 0 for a test that does not fit.
///
/// Equation  chance = sum_i w_i P(w_i p_i(x) / sum_j w_j p_j(x) >= level | i is true)
/// Symbols   w probabilities before the tests; x outcomes of all these tests; p_i(x) their density under hypothesis i,
///           the product over the tests
/// Validity  given a hypothesis, tests are independent: what one says about the parameters does not improve the
///           prediction of the next. Which tests follow does not depend on outcomes. 64 seeded draws under each
///           hypothesis
/// Checked   tests/diagnosis/naming_chance_test.cpp
std::vector<double> find_naming_chances(const std::vector<double>& probabilities,
                                        const std::vector<PossibleTest>& tests, double hours, double level);

}  // namespace rollrig::diagnosis
