#include "estimation/uncertainty/covariance_root.h"

#include <cmath>

namespace rollrig::estimation {

Eigen::MatrixXd calc_covariance_root(const Eigen::MatrixXd& covariance) {
  constexpr double kNothing = 1e-12;  // of a variance: what rounding leaves
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
  for (Eigen::Index j = 0; j < covariance.rows(); ++j) {
    const double left = covariance(j, j) - root.row(j).head(j).squaredNorm();
    if (left <= kNothing * covariance(j, j)) continue;
    root(j, j) = std::sqrt(left);
    for (Eigen::Index i = j + 1; i < covariance.rows(); ++i) {
      root(i, j) = (covariance(i, j) - root.row(i).head(j).dot(root.row(j).head(j))) / root(j, j);
    }
  }
  return root;
}

}  // namespace rollrig::estimation
