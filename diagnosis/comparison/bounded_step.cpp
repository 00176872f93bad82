#include "diagnosis/comparison/bounded_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace rollrig::diagnosis {
namespace {

/// The free unknowns, the others as they are in `x`.
void solve_free(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& gradient,
                const std::vector<Eigen::Index>& free, Eigen::VectorXd& x) {
  const auto n = static_cast<Eigen::Index>(free.size());
  for (const Eigen::Index i : free) x[i] = 0.0;
  const Eigen::VectorXd rest = gradient - curvature * x;
  Eigen::MatrixXd part(n, n);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index row = free[static_cast<std::size_t>(i)];
    right[i] = rest[row];
    for (Eigen::Index k = 0; k < n; ++k) part(i, k) = curvature(row, free[static_cast<std::size_t>(k)]);
  }
  const Eigen::VectorXd solved = part.llt().solve(right);
  for (Eigen::Index i = 0; i < n; ++i) x[free[static_cast<std::size_t>(i)]] = solved[i];
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
