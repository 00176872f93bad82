#include "estimation/road_load/variance_components.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Inverse {
  MatrixXd matrix;
  double log_determinant = 0.0;  // of what was inverted
};

Inverse invert_with_determinant(const MatrixXd& matrix) {
  constexpr double kLeastPivot = 1e-14;  // of a matrix with a unit diagonal
  const VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<MatrixXd> factor(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (!scale.allFinite() || factor.info() != Eigen::Success || factor.vectorD().minCoeff() < kLeastPivot) {
    throw RunFailure("the coastdowns do not decide the coefficients: wider or more speeds are needed");
  }
  return {scale.asDiagonal() * factor.solve(MatrixXd::Identity(matrix.rows(), matrix.cols())) * scale.asDiagonal(),
          factor.vectorD().array().log().sum() - 2.0 * scale.array().log().sum()};
}

MatrixXd invert(const MatrixXd& matrix) { return invert_with_determinant(matrix).matrix; }

/// What the blocks give at one set of components.
struct Sums {
  MatrixXd Q;  // (X'WX)^-1
  VectorXd beta;
  std::vector<MatrixXd> S;  // X'W V_i W X
  MatrixXd H;               // tr(P V_i P V_j)
  VectorXd trace;           // tr(W V_i W V_i), of which H(i, i) is what the coefficients leave
  VectorXd q;               // y'P V_i P y
  double chi2 = 0.0;
  double log_determinants = 0.0;  // log|V| + log|X'WX|
};

struct Weighted {
  MatrixXd W, WX;
  VectorXd Wy;
  double log_determinant = 0.0;  // of V
};

Weighted weigh(const LinearBlock& block, const VectorXd& components) {
  MatrixXd V = MatrixXd::Zero(block.y.size(), block.y.size());
  for (std::size_t i = 0; i < block.patterns.size(); ++i) V += components(static_cast<Index>(i)) * block.patterns[i];
  Inverse inverse = invert_with_determinant(V);
  Weighted weighted;
  weighted.log_determinant = inverse.log_determinant;
  weighted.W = std::move(inverse.matrix);
  weighted.WX = weighted.W * block.X;
  weighted.Wy = weighted.W * block.y;
  return weighted;
}

/// Normal equations and, for the scoring, the traces.
Sums sum_up(const std::vector<LinearBlock>& blocks, const VectorXd& components, bool with_traces) {
  const Index p = blocks.front().X.cols();
  const Index m = components.size();
  Sums sums;
  std::vector<Weighted> weighted;
  MatrixXd N = MatrixXd::Zero(p, p);
  VectorXd b = VectorXd::Zero(p);
  for (const LinearBlock& block : blocks) {
    weighted.push_back(weigh(block, components));
    sums.log_determinants += weighted.back().log_determinant;
    N += block.X.transpose() * weighted.back().WX;
    b += block.X.transpose() * weighted.back().Wy;
  }
  Inverse inverse = invert_with_determinant(N);
  sums.log_determinants += inverse.log_determinant;
  sums.Q = std::move(inverse.matrix);
  sums.beta = sums.Q * b;
  sums.S.assign(static_cast<std::size_t>(m), MatrixXd::Zero(p, p));
  sums.H = MatrixXd::Zero(m, m);
  sums.trace = VectorXd::Zero(m);
  sums.q = VectorXd::Zero(m);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const LinearBlock& block = blocks[k];
    const VectorXd rest = weighted[k].Wy - weighted[k].WX * sums.beta;  // P y
    sums.chi2 += rest.dot(block.y - block.X * sums.beta);
    if (!with_traces) continue;
    std::vector<MatrixXd> G, U;
    for (Index i = 0; i < m; ++i) {
      const MatrixXd& pattern = block.patterns[static_cast<std::size_t>(i)];
      G.push_back(weighted[k].W * pattern);
      U.push_back(pattern * weighted[k].WX);
      sums.S[static_cast<std::size_t>(i)] += weighted[k].WX.transpose() * U.back();
      sums.q(i) += rest.dot(pattern * rest);
      for (Index j = 0; j <= i; ++j) {
        const auto sj = static_cast<std::size_t>(j);
        const double direct = G.back().cwiseProduct(G[sj].transpose()).sum();
        const double through_fit = (U.back().transpose() * weighted[k].W * U[sj]).cwiseProduct(sums.Q).sum();
        sums.H(i, j) += direct - 2.0 * through_fit;
        if (j == i) sums.trace(i) += direct;
      }
    }
  }
  for (Index i = 0; i < m && with_traces; ++i) {
    for (Index j = 0; j <= i; ++j) {
      const MatrixXd left = sums.Q * sums.S[static_cast<std::size_t>(i)];
      const MatrixXd right = sums.Q * sums.S[static_cast<std::size_t>(j)];
      sums.H(i, j) += left.cwiseProduct(right.transpose()).sum();
      sums.H(j, i) = sums.H(i, j);
    }
  }
  return sums;
}

/// The square system of components that differ by many powers of ten, in units in which its diagonal is one.
class ScaledSystem {
 public:
  explicit ScaledSystem(const MatrixXd& H) : unit_(H.diagonal().cwiseSqrt().cwiseInverse()) {
    scaled_ = unit_.asDiagonal() * H * unit_.asDiagonal();
  }
  VectorXd solve(const VectorXd& q) const {
    return unit_.cwiseProduct(scaled_.colPivHouseholderQr().solve(unit_.cwiseProduct(q)));
  }
  MatrixXd inverse() const {
    return unit_.asDiagonal() * MatrixXd(scaled_.completeOrthogonalDecomposition().pseudoInverse()) *
           unit_.asDiagonal();
  }

 private:
  VectorXd unit_;
  MatrixXd scaled_;
};

/// Solves H s = q over the components that the data decide, negative ones put to their floor.
VectorXd solve_components(const Sums& sums, const VectorXd& floors, const std::vector<bool>& decided,
                          std::vector<Index>& kept) {
  kept.clear();
  for (Index i = 0; i < floors.size(); ++i) {
    if (decided[static_cast<std::size_t>(i)]) kept.push_back(i);
  }
  VectorXd components = floors;
  while (!kept.empty()) {
    VectorXd q = sums.q(kept);
    for (Index j = 0; j < floors.size(); ++j) {
      if (std::find(kept.begin(), kept.end(), j) == kept.end()) q -= sums.H(kept, j) * floors(j);
    }
    const VectorXd s = ScaledSystem(sums.H(kept, kept)).solve(q);
    std::size_t worst = kept.size();
    double least = 0.0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double share = s(static_cast<Index>(i)) * std::sqrt(sums.H(kept[i], kept[i]));
      if (s(static_cast<Index>(i)) < floors(kept[i]) && (worst == kept.size() || share < least)) {
        worst = i;
        least = share;
      }
    }
    if (worst == kept.size()) {
      components(kept) = s;
      break;
    }
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return components;
}

}  // namespace

LinearEstimate solve_weighted(const std::vector<LinearBlock>& blocks, const VectorXd& components) {
  const Sums sums = sum_up(blocks, components, false);
  LinearEstimate estimate;
  estimate.coefficients = sums.beta;
  estimate.covariance = sums.Q;
  estimate.components = components;
  estimate.chi2 = sums.chi2;
  estimate.log_likelihood = -0.5 * (sums.log_determinants + sums.chi2);
  return estimate;
}

LinearBlock join_blocks(const std::vector<LinearBlock>& parts) {
  Eigen::Index n = 0;
  for (const LinearBlock& part : parts) n += part.y.size();
  LinearBlock joined{Eigen::VectorXd(n), Eigen::MatrixXd(n, parts.front().X.cols()), {}};
  joined.patterns.assign(parts.front().patterns.size(), Eigen::MatrixXd::Zero(n, n));
  Eigen::Index row = 0;
  for (const LinearBlock& part : parts) {
    const Eigen::Index rows = part.y.size();
    joined.y.segment(row, rows) = part.y;
    joined.X.middleRows(row, rows) = part.X;
    for (std::size_t i = 0; i < part.patterns.size(); ++i) {
      joined.patterns[i].block(row, row, rows, rows) = part.patterns[i];
    }
    row += rows;
  }
  return joined;
}

LinearEstimate step_variance_components(const std::vector<LinearBlock>& blocks, const VectorXd& components,
                                        const VectorXd& floors) {
  constexpr double kUndecided = 1e-6;  // share of a pattern that the coefficients leave. Assumed
  const Sums sums = sum_up(blocks, components, true);
  LinearEstimate estimate;
  estimate.coefficients = sums.beta;
  estimate.covariance = sums.Q;
  estimate.chi2 = sums.chi2;
  estimate.log_likelihood = -0.5 * (sums.log_determinants + sums.chi2);
  for (Index i = 0; i < components.size(); ++i) {
    estimate.decided.push_back(sums.H(i, i) > kUndecided * sums.trace(i));
  }
  std::vector<Index> kept;
  estimate.components = solve_components(sums, floors, estimate.decided, kept);
  estimate.degrees_freedom = VectorXd::Constant(sums.beta.size(), std::numeric_limits<double>::infinity());
  if (kept.empty()) return estimate;
  const MatrixXd variance = ScaledSystem(sums.H(kept, kept)).inverse();
  for (Index c = 0; c < sums.beta.size(); ++c) {
    VectorXd gradient(static_cast<Index>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      gradient(static_cast<Index>(i)) = (sums.Q.row(c) * sums.S[static_cast<std::size_t>(kept[i])]).dot(sums.Q.col(c));
    }
    const double spread = gradient.dot(variance * gradient);
    if (spread > 0.0) estimate.degrees_freedom(c) = sums.Q(c, c) * sums.Q(c, c) / spread;
  }
  return estimate;
}

void apply_bounds(LinearEstimate& estimate, const VectorXd& lower, const VectorXd& upper) {
  const Index p = estimate.coefficients.size();
  const Index bounded = lower.size();
  const MatrixXd N = invert(estimate.covariance);
  double best = std::numeric_limits<double>::infinity();
  LinearEstimate found = estimate;
  int choices = 1;
  for (Index i = 0; i < bounded; ++i) choices *= 3;
  for (int choice = 0; choice < choices; ++choice) {  // each coefficient free, on its lower or on its upper bound
    std::vector<Index> free_ones;
    VectorXd shift = VectorXd::Zero(p);
    bool possible = true;
    int code = choice;
    for (Index i = 0; i < p; ++i) {
      const int state = i < bounded ? code % 3 : 0;
      if (i < bounded) code /= 3;
      if (state == 0) {
        free_ones.push_back(i);
        continue;
      }
      const double bound = state == 1 ? lower(i) : upper(i);
      possible = possible && std::isfinite(bound);
      shift(i) = bound - estimate.coefficients(i);
    }
    if (!possible) continue;
    const VectorXd pull = -(N * shift);
    VectorXd moved = shift;
    MatrixXd covariance = MatrixXd::Zero(p, p);
    if (!free_ones.empty()) {
      const MatrixXd inverse = invert(N(free_ones, free_ones));
      covariance(free_ones, free_ones) = inverse;
      for (Index j = 0; j < inverse.cols(); ++j) {
        moved(free_ones) += inverse.col(j) * pull(free_ones[static_cast<std::size_t>(j)]);
      }
    }
    const VectorXd value = estimate.coefficients + moved;
    for (Index i = 0; i < bounded; ++i) {
      const double slack = 1e-12 * (1.0 + std::abs(value(i)));
      possible = possible && value(i) >= lower(i) - slack && value(i) <= upper(i) + slack;
    }
    const double rise = moved.dot(N * moved);
    if (!possible || rise >= best) continue;
    best = rise;
    found.coefficients = value;
    found.covariance = covariance;
  }
  estimate = found;
}

}  // namespace rollrig::estimation
