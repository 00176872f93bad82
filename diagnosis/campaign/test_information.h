#pragma once
/// What a test tells of effects and of the numbers of the files, to first order.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/next_test/test_menu.h"
#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// A term at a size at which its visibility is judged; shapes are in the middle of their priors.
struct JudgedSize {
  SignedTerm term;
  double u = 0.0;  // of the size, in prior units
};

/// The middle of the prior with each sign that it may have; one prior unit to either side where the term does nothing
/// in the middle.
std::vector<JudgedSize> list_judged_sizes(const Term& term);

/// What a test tells, of base numbers in prior units, and of effects in judged sizes; offsets of its sensors, which are
/// new, are averaged over. That of several tests is the sum, since they share nothing else.
/// Equation  base = J^T P J, through = J^T P G, squares = diag(G^T P G), P = 1 - O (1 + O^T O)^-1 O^T
/// Symbols   J, G whitened changes of all block means by the base numbers and by each effect, O those by offsets in
///           their standard deviations
struct TestInformation {
  Eigen::MatrixXd base;
  Eigen::MatrixXd through;
  Eigen::VectorXd squares;

  TestInformation& operator+=(const TestInformation& other);
  TestInformation& operator-=(const TestInformation& other);
  /// d' of each judged size.
  /// Equation  d'^2 = g^T g - (J^T g)^T (1 + J^T J)^-1 (J^T g), as in the screening of a diagnosis
  Eigen::VectorXd calc_detectability() const;
};

/// Of no test at all.
TestInformation make_no_information(const Study& study, const std::vector<JudgedSize>& sizes);

/// Of a test of the menu of a study; none where it cannot be simulated without effects.
/// Validity  linear in base numbers; the errors of the equations are those of the baseline (ModelError). A size that
///           cannot be simulated on the test counts as not changed by it
/// Checked   tests/diagnosis/campaign_test.cpp
std::optional<TestInformation> predict_information(const Study& study, const std::vector<JudgedSize>& sizes,
                                                   const PlannedTest& test);

}  // namespace rollrig::diagnosis
