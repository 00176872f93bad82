#pragma once
/// What a test tells of effects and of base parameters, to first order.

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

/// The middle of the prior, with each sign that the size may have. If the term does nothing in the middle, one prior
/// unit to either side.
std::vector<JudgedSize> list_judged_sizes(const Term& term);

/// What a test tells of base parameters, in prior units, and of effects, in judged sizes. Its sensor offsets are new
/// and are averaged over. The information of several tests is the sum of theirs, since base parameters and effects are
/// all that they have in common.
/// Equation  base = J^T P J, through = J^T P G, squares = diag(G^T P G), P = I - O (I + O^T O)^-1 O^T
/// Symbols   J whitened derivatives of all block means by the base parameters; G whitened changes by each judged size;
///           O whitened changes by the offsets, in their standard deviations; I unit matrix
struct TestInformation {
  Eigen::MatrixXd base;
  Eigen::MatrixXd through;
  Eigen::VectorXd squares;

  TestInformation& operator+=(const TestInformation& other);
  /// d' of each judged size.
  /// Equation  d'^2 = squares - through^T (I + base)^-1 through, as in the screening of a diagnosis
  Eigen::VectorXd calc_detectability() const;
};

/// The information of no test: zeros.
TestInformation make_no_information(const Study& study, const std::vector<JudgedSize>& sizes);

/// The information of a test of the menu; none if it cannot be simulated without effects.
/// Validity  linear in base parameters; the discrepancy is that of the baseline (ModelError). A judged size that cannot
///           be simulated on this test counts as if it changed nothing
/// Checked   tests/diagnosis/campaign_test.cpp
std::optional<TestInformation> predict_information(const Study& study, const std::vector<JudgedSize>& sizes,
                                                   const PlannedTest& test);

}  // namespace rollrig::diagnosis
