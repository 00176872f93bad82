#pragma once
/// The best step of a linear fit whose unknowns have bounds.

#include <Eigen/Core>

namespace rollrig::diagnosis {

/// Equation  minimum of x^T M x / 2 - b^T x with lower <= x <= upper: solved without bounds, the unknown furthest
///           outside is put on its bound and the others solved anew, until none is outside
/// Symbols   M symmetric and positive definite; x in prior units
/// Validity  an unknown that is put on its bound stays there; exact where at most one is outside
/// Source    active sets, without release: Nocedal and Wright, Numerical Optimization, 2nd ed., chapter 16.5
/// Checked   tests/diagnosis/bounded_step_test.cpp
Eigen::VectorXd solve_within(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& gradient,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace rollrig::diagnosis
