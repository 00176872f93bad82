#include "diagnosis/comparison/bounded_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace rollrig::diagnosis {
namespace {

/// The free unknowns, the others as they are in `x`.
void solve_free(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& gradient,
                const std::vector<Eigen::Index>& free, Eigen::VectorXd& x) {
  x(free).setZero();
  const Eigen::VectorXd rest = gradient - curvature * x;
  const Eigen::MatrixXd part = curvature(free, free);
  const Eigen::VectorXd right = rest(free);
  const Eigen::VectorXd solved = part.llt().solve(right);
  x(free) = solved;
}

}  // namespace

Eigen::VectorXd solve_within(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& gradient,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(gradient.size());
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < x.size(); ++i) free.push_back(i);
  while (!free.empty()) {
    solve_free(curvature, gradient, free, x);
    std::size_t furthest = 0;
    double outside = 0.0;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const double by = std::max(lower[free[k]] - x[free[k]], x[free[k]] - upper[free[k]]);
      if (by > outside) {
        outside = by;
        furthest = k;
      }
    }
    if (outside <= 0.0) break;
    double& value = x[free[furthest]];
    value = value < lower[free[furthest]] ? lower[free[furthest]] : upper[free[furthest]];
    free.erase(free.begin() + static_cast<std::ptrdiff_t>(furthest));
  }
  return x;
}

}  // namespace rollrig::diagnosis
