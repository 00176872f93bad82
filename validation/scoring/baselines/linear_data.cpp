#include "validation/scoring/baselines/linear_data.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace rollrig::validation {

BaseProjection::BaseProjection(const diagnosis::RowMatrix& jacobian) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobian.transpose() * jacobian);
  constexpr double kNegligible = 1e-12;
  const Eigen::VectorXd& squares = solver.eigenvalues();  // increasing
  const Eigen::Index kept = squares.size() == 0 ? 0 : (squares.array() > kNegligible * squares.maxCoeff()).count();
  const Eigen::ArrayXd square = squares.tail(kept).array();
  directions_ = jacobian * solver.eigenvectors().rightCols(kept) * square.rsqrt().matrix().asDiagonal();
  taken_ = (1.0 - (1.0 + square).rsqrt()).matrix();
}

Eigen::MatrixXd BaseProjection::apply(const Eigen::MatrixXd& columns) const {
  return columns - directions_ * (taken_.asDiagonal() * (directions_.transpose() * columns));
}

LeastSquares::LeastSquares(const LinearData& data) : chi2_(data.residual.squaredNorm()) {
  constexpr double kShortest = 1e-9;  // of a signature that shows nothing
  lengths_ = data.signatures.colwise().norm().cwiseMax(kShortest);
  const Eigen::MatrixXd scaled = data.signatures * lengths_.cwiseInverse().asDiagonal();
  products_ = scaled.transpose() * scaled;
  along_ = scaled.transpose() * data.residual;
}

LeastSquares::Fit LeastSquares::fit(const std::vector<std::size_t>& columns) const {
  const Eigen::MatrixXd products = products_(columns, columns);
  const Eigen::VectorXd along = along_(columns);
  const Eigen::VectorXd lengths = lengths_(columns);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(1e-9);  // of twins: rounding, not difference
  decomposition.compute(products);
  const Eigen::VectorXd scaled = decomposition.solve(along);
  const Eigen::VectorXd variances = decomposition.pseudoInverse().diagonal();
  return {scaled.cwiseQuotient(lengths), variances.cwiseMax(0.0).cwiseSqrt().cwiseQuotient(lengths),
          chi2_ - scaled.dot(along)};
}

}  // namespace rollrig::validation
