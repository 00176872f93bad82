#include "validation/generator/observer.h"

namespace rollrig::generator {
namespace {

Eigen::MatrixXd put_below(const Eigen::MatrixXd& above, const Eigen::MatrixXd& below) {
  Eigen::MatrixXd both(above.rows() + below.rows(), above.cols());
  both << above, below;
  return both;
}

}  // namespace

Observer::Observer(const Eigen::MatrixXd& unknowns)
    : unknowns_(unknowns.cols()),
      columns_(put_below(unknowns, Eigen::MatrixXd::Identity(unknowns.cols(), unknowns.cols()))) {}

Eigen::MatrixXd Observer::reduce(const Eigen::MatrixXd& signals) const {
  Eigen::MatrixXd turned = put_below(signals, Eigen::MatrixXd::Zero(unknowns_, signals.cols()));
  turned.applyOnTheLeft(columns_.householderQ().adjoint());
  return turned.bottomRows(signals.rows());
}

Eigen::VectorXd Observer::fit(const Eigen::VectorXd& signal) const {
  return columns_.solve(put_below(signal, Eigen::MatrixXd::Zero(unknowns_, 1)));
}

double expect_log_bayes_factor(const Eigen::VectorXd& signal, const Eigen::MatrixXd& alternatives) {
  constexpr double kStrength = 3.0;
  return 0.5 * Observer(kStrength * alternatives).reduce(signal).squaredNorm();
}

}  // namespace rollrig::generator
