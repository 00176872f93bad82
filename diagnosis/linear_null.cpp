#include "diagnosis/linear_null.h"

namespace rollrig::diagnosis {

LinearNull::LinearNull(const Remainder& remainder_, const Contender& null)
    : remainder(remainder_),
      amplitudes(null.amplitudes),
      jacobian(null.fit.jacobian),
      residual(null.fit.residuals - null.fit.jacobian * null.fit.unknowns) {
  remainder.whiten(amplitudes, jacobian);
  remainder.whiten(amplitudes, residual);  // of the priors' middles
  const Eigen::Index n = jacobian.cols();
  curvature = jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(n, n);
  unknowns = -curvature.llt().solve(jacobian.transpose() * residual);
  residual += jacobian * unknowns;
}

void LinearNull::whiten(RowMatrix& columns) const {
  diagnosis::whiten(remainder.set(), columns);
  remainder.whiten(amplitudes, columns);
}

}  // namespace rollrig::diagnosis
