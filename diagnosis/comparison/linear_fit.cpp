#include "diagnosis/comparison/linear_fit.h"

namespace rollrig::diagnosis {

LinearFit::LinearFit(const Discrepancy& discrepancy_, const Candidate& candidate)
    : discrepancy(discrepancy_),
      amplitudes(candidate.amplitudes),
      jacobian(candidate.fit.jacobian),
      residual(candidate.fit.residuals - candidate.fit.jacobian * candidate.fit.unknowns) {
  discrepancy.whiten(amplitudes, jacobian);
  discrepancy.whiten(amplitudes, residual);  // of the priors' middles
  const Eigen::Index n = jacobian.cols();
  curvature = jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(n, n);
  factor.compute(curvature);
  unknowns = -factor.solve(jacobian.transpose() * residual);
  residual += jacobian * unknowns;
}

LinearFit::Score LinearFit::calc_score(Eigen::VectorXd difference) const {
  whiten(difference);
  const Eigen::VectorXd through = jacobian.transpose() * difference;
  return {difference.dot(residual), difference.squaredNorm() - through.dot(factor.solve(through))};
}

}  // namespace rollrig::diagnosis
