#pragma once
/// What can be seen of a signal by one who knows everything but some numbers.

#include <Eigen/Core>
#include <Eigen/QR>

namespace rollrig::generator {

/// Takes out of signals what unknowns of a normal prior can do. Signals are whitened: unit noise.
/// Equation  <s, t> = s^T (I + U U^T)^-1 t, as the scalar product of what a projection of [s; 0] and [t; 0] out of the
///           columns [U; I] leaves
/// Symbols   U what each unknown does by one standard deviation of its prior
/// Checked   tests/validation/generator/observer_test.cpp
class Observer {
 public:
  /// Columns of `unknowns` are U.
  explicit Observer(const Eigen::MatrixXd& unknowns);

  /// Columns whose scalar products are <s, t>, so that the norm of one is its d'.
  Eigen::MatrixXd reduce(const Eigen::MatrixXd& signals) const;

  /// The unknowns that fit a signal best under their prior, in its standard deviations: (I + U^T U)^-1 U^T s.
  Eigen::VectorXd fit(const Eigen::VectorXd& signal) const;

 private:
  Eigen::Index unknowns_;
  Eigen::HouseholderQR<Eigen::MatrixXd> columns_;
};

/// Expected logarithm of the Bayes factor for a signal against alternatives of unknown strength; all reduced.
/// Equation  ln B = s^T (I + 9 G G^T)^-1 s/2
/// Assumed   strengths about 0 with a standard deviation of 3 of what the columns G show
double expect_log_bayes_factor(const Eigen::VectorXd& signal, const Eigen::MatrixXd& alternatives);

}  // namespace rollrig::generator
