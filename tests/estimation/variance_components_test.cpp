#include "estimation/road_load/variance_components.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "sim/core/error.h"
#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kGroups = 6;
constexpr int kMembers = 4;

/// Groups of equal size about one mean: white scatter and scatter from group to group.
std::vector<LinearBlock> make_groups(double within_sd, double between_sd, std::uint64_t seed) {
  RandomStream random(seed, "groups");
  std::vector<LinearBlock> blocks;
  for (int g = 0; g < kGroups; ++g) {
    LinearBlock block;
    const double shift = between_sd * random.normal();
    block.y = VectorXd(kMembers);
    for (int i = 0; i < kMembers; ++i) block.y(i) = 10.0 + shift + within_sd * random.normal();
    block.X = MatrixXd::Ones(kMembers, 1);
    block.patterns = {MatrixXd::Identity(kMembers, kMembers), MatrixXd::Ones(kMembers, kMembers)};
    blocks.push_back(block);
  }
  return blocks;
}

LinearEstimate settle(const std::vector<LinearBlock>& blocks) {
  VectorXd components = VectorXd::Ones(2);
  LinearEstimate estimate;
  for (int i = 0; i < 50; ++i) {
    estimate = step_variance_components(blocks, components, VectorXd::Constant(2, 1e-12));
    components = estimate.components;
  }
  return estimate;
}

/// Mean squares within and between groups.
std::array<double, 2> mean_squares(const std::vector<LinearBlock>& blocks) {
  double grand = 0.0;
  for (const LinearBlock& block : blocks) grand += block.y.mean() / kGroups;
  double within = 0.0, between = 0.0;
  for (const LinearBlock& block : blocks) {
    within += (block.y.array() - block.y.mean()).square().sum() / (kGroups * (kMembers - 1));
    between += kMembers * std::pow(block.y.mean() - grand, 2) / (kGroups - 1);
  }
  return {within, between};
}

}  // namespace

TEST_CASE("balanced groups: restricted likelihood is the analysis of variance", "[fast]") {
  const auto blocks = make_groups(1.0, 3.0, 4);
  const auto [within, between] = mean_squares(blocks);
  const LinearEstimate estimate = settle(blocks);
  CHECK(estimate.components(0) == Approx(within).epsilon(1e-8));
  CHECK(estimate.components(1) == Approx((between - within) / kMembers).epsilon(1e-8));
  CHECK(estimate.covariance(0, 0) == Approx(between / (kGroups * kMembers)).epsilon(1e-8));
  // the mean of groups has as many degrees of freedom as there are groups, less one
  CHECK(estimate.degrees_freedom(0) == Approx(kGroups - 1.0).epsilon(1e-6));
}

TEST_CASE("groups that differ less than by chance: the component is nought", "[fast]") {
  auto blocks = make_groups(1.0, 0.0, 1);
  for (LinearBlock& block : blocks) block.y.array() += 10.0 - block.y.mean();  // equal means
  const LinearEstimate estimate = settle(blocks);
  CHECK(estimate.components(1) < 1e-9);
  CHECK(estimate.components(0) > 0.3);
}

TEST_CASE("one group cannot tell how groups differ", "[fast]") {
  const auto blocks = make_groups(1.0, 1.0, 2);
  const LinearEstimate estimate =
      step_variance_components({blocks.front()}, VectorXd::Ones(2), VectorXd::Constant(2, 1e-12));
  CHECK(estimate.decided[0]);
  CHECK_FALSE(estimate.decided[1]);
}

TEST_CASE("bounds: a free optimum stays, one outside goes to the bound and the others follow", "[fast]") {
  LinearBlock block;
  block.y = VectorXd(3);
  block.y << 1.0, -1.0, 2.0;
  block.X = MatrixXd(3, 2);
  block.X << 1.0, 0.0, 0.0, 1.0, 1.0, 1.0;
  block.patterns = {MatrixXd::Identity(3, 3)};
  // normal equations: [2 1; 1 2] b = [3; 1], so b = (5/3, -1/3); with b2 = 0: b1 = 3/2
  LinearEstimate estimate = solve_weighted({block}, VectorXd::Ones(1));
  CHECK(estimate.coefficients(0) == Approx(5.0 / 3.0));
  CHECK(estimate.coefficients(1) == Approx(-1.0 / 3.0));
  const double none = std::numeric_limits<double>::infinity();
  LinearEstimate wide = estimate;
  apply_bounds(wide, VectorXd::Constant(2, -10.0), VectorXd::Constant(2, none));
  CHECK(wide.coefficients(0) == Approx(5.0 / 3.0));
  apply_bounds(estimate, VectorXd::Zero(2), VectorXd::Constant(2, none));
  CHECK(estimate.coefficients(0) == Approx(1.5));
  CHECK(estimate.coefficients(1) == 0.0);
  CHECK(estimate.covariance(1, 1) == 0.0);
  CHECK(estimate.covariance(0, 0) == Approx(0.5));
}

TEST_CASE("coefficients that the data do not decide are refused", "[fast]") {
  LinearBlock block;
  block.y = VectorXd::Ones(3);
  block.X = MatrixXd::Ones(3, 2);
  block.patterns = {MatrixXd::Identity(3, 3)};
  CHECK_THROWS_AS(solve_weighted({block}, VectorXd::Ones(1)), RunFailure);
}

TEST_CASE("restricted log likelihood is that of contrasts which the coefficients leave", "[fast]") {
  // Rows of K: an orthonormal basis of what is orthogonal to X; K y has no mean, whatever the coefficients. In terms
  // of them, log|V| + log|X'WX| = log|K V K'| + log|X'X|.
  RandomStream random(7, "contrasts");
  std::vector<LinearBlock> blocks;
  MatrixXd X(12, 2), V = MatrixXd::Zero(12, 12);
  VectorXd y(12);
  const VectorXd components = Eigen::Vector2d(0.7, 2.5);
  for (int b = 0; b < 3; ++b) {
    LinearBlock block{VectorXd(4), MatrixXd(4, 2), {MatrixXd::Identity(4, 4), MatrixXd(4, 4)}};
    VectorXd shape(4);
    for (int i = 0; i < 4; ++i) {
      block.y(i) = 3.0 + random.normal();
      block.X.row(i) << 1.0, random.normal();
      shape(i) = 1.0 + 0.5 * i;
    }
    block.patterns[1] = shape * shape.transpose();
    y.segment(4 * b, 4) = block.y;
    X.middleRows(4 * b, 4) = block.X;
    V.block(4 * b, 4 * b, 4, 4) = components(0) * block.patterns[0] + components(1) * block.patterns[1];
    blocks.push_back(block);
  }
  const Eigen::HouseholderQR<MatrixXd> parts(X);
  const MatrixXd K = MatrixXd(parts.householderQ()).rightCols(10).transpose();
  const MatrixXd of_contrasts = K * V * K.transpose();
  const VectorXd z = K * y;
  const double log_likelihood = -0.5 * (std::log(of_contrasts.determinant()) + z.dot(of_contrasts.inverse() * z) +
                                        std::log((X.transpose() * X).determinant()));
  const VectorXd floors = VectorXd::Constant(2, 1e-12);
  CHECK(step_variance_components(blocks, components, floors).log_likelihood == Approx(log_likelihood).epsilon(1e-9));
  CHECK(solve_weighted(blocks, components).log_likelihood == Approx(log_likelihood).epsilon(1e-9));
}
