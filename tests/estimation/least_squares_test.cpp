// Nonlinear least squares within bounds.
#include "estimation/least_squares/least_squares.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace rollrig::estimation;

namespace {

/// r = (10 (y - x^2), 1 - x), the function of Rosenbrock: zero at (1, 1), along a bent valley.
bool put_rosenbrock(const double* u, double* residuals, double* jacobian) {
  residuals[0] = 10.0 * (u[1] - u[0] * u[0]);
  residuals[1] = 1.0 - u[0];
  if (jacobian != nullptr) {
    jacobian[0] = -20.0 * u[0];
    jacobian[1] = 10.0;
    jacobian[2] = -1.0;
    jacobian[3] = 0.0;
  }
  return true;
}

LeastSquaresProblem make_rosenbrock() {
  LeastSquaresProblem problem;
  problem.residuals = 2;
  problem.evaluate = put_rosenbrock;
  return problem;
}

LeastSquaresOptions with(LeastSquaresOptions::Factorization factorization) {
  LeastSquaresOptions options;
  options.factorization = factorization;
  options.most_iterations = 200;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-14;
  return options;
}

using Factorization = LeastSquaresOptions::Factorization;

}  // namespace

TEST_CASE("the least squares of a bent valley are found by both factorizations", "[fast]") {
  for (const Factorization factorization : {Factorization::kQr, Factorization::kNormalCholesky}) {
    std::vector<double> unknowns{-1.2, 1.0};
    const LeastSquaresResult result = minimize_squares(make_rosenbrock(), with(factorization), unknowns);
    CHECK(result.is_usable);
    CHECK(result.has_converged);
    CHECK(result.half_sum < 1e-20);
    CHECK(unknowns[0] == Approx(1.0).epsilon(1e-9));
    CHECK(unknowns[1] == Approx(1.0).epsilon(1e-9));
  }
}

TEST_CASE("an unknown stays within its bounds, and the other is the best beside it", "[fast]") {
  // r = (u0 - 2, u0 + 3 u1 - 5): zero at (2, 1); with u0 at most 1, the best is (1, 4/3).
  LeastSquaresProblem problem;
  problem.residuals = 2;
  problem.evaluate = [](const double* u, double* residuals, double* jacobian) {
    residuals[0] = u[0] - 2.0;
    residuals[1] = u[0] + 3.0 * u[1] - 5.0;
    const double rows[4] = {1.0, 0.0, 1.0, 3.0};
    if (jacobian != nullptr) std::copy(rows, rows + 4, jacobian);
    return true;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  problem.lower = {-infinity, -infinity};
  problem.upper = {1.0, infinity};
  std::vector<double> unknowns{-1.2, 7.0};
  const LeastSquaresResult result = minimize_squares(problem, with(Factorization::kQr), unknowns);
  CHECK(result.has_converged);
  CHECK(unknowns[0] == 1.0);
  CHECK(unknowns[1] == Approx(4.0 / 3.0).epsilon(1e-6));
  CHECK(result.half_sum == Approx(0.5).epsilon(1e-9));
}

TEST_CASE("the least squares of lines within bounds are those of the best choice of bounds", "[fast]") {
  // r = M u - d with columns that are nearly alike: the best is found by trying every choice of unknowns that are held
  // on either bound, where the others are within theirs.
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  constexpr double kBound = 0.3;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd m(6, 3);
    Eigen::VectorXd d(6);
    for (int row = 0; row < 6; ++row) {
      const double common = normal(random);
      for (int column = 0; column < 3; ++column) m(row, column) = common + 0.3 * normal(random);
      d(row) = normal(random);
    }
    double least = std::numeric_limits<double>::infinity();
    for (int choice = 0; choice < 27; ++choice) {  // a digit of 3 for each unknown: free, lower, upper
      const std::array<int, 3> digits{choice % 3, choice / 3 % 3, choice / 9};
      Eigen::VectorXd rest = d;
      std::vector<int> free;
      Eigen::VectorXd u = Eigen::VectorXd::Zero(3);
      for (int i = 0; i < 3; ++i) {
        if (digits[static_cast<std::size_t>(i)] == 0) free.push_back(i);
        if (digits[static_cast<std::size_t>(i)] > 0) u(i) = digits[static_cast<std::size_t>(i)] == 1 ? -kBound : kBound;
      }
      rest -= m * u;
      if (!free.empty()) {
        Eigen::MatrixXd of_free(6, static_cast<Eigen::Index>(free.size()));
        for (std::size_t i = 0; i < free.size(); ++i) of_free.col(static_cast<Eigen::Index>(i)) = m.col(free[i]);
        const Eigen::VectorXd found = of_free.colPivHouseholderQr().solve(rest);
        for (std::size_t i = 0; i < free.size(); ++i) u(free[i]) = found(static_cast<Eigen::Index>(i));
      }
      if (u.cwiseAbs().maxCoeff() <= kBound) least = std::min(least, 0.5 * (m * u - d).squaredNorm());
    }
    LeastSquaresProblem problem;
    problem.residuals = 6;
    problem.evaluate = [&](const double* u, double* residuals, double* jacobian) {
      Eigen::Map<Eigen::VectorXd> to_residuals(residuals, 6);
      to_residuals = m * Eigen::Map<const Eigen::VectorXd>(u, 3) - d;
      if (jacobian == nullptr) return true;
      Eigen::Map<Eigen::Matrix<double, 6, 3, Eigen::RowMajor>> to_jacobian(jacobian);
      to_jacobian = m;
      return true;
    };
    problem.lower.assign(3, -kBound);
    problem.upper.assign(3, kBound);
    std::vector<double> unknowns(3, 0.1);
    LeastSquaresOptions options;
    options.most_iterations = 300;
    options.function_tolerance = 1e-10;
    const LeastSquaresResult result = minimize_squares(problem, options, unknowns);
    INFO("trial " << trial);
    CHECK(result.has_converged);
    CHECK(result.half_sum == Approx(least).epsilon(1e-6));
  }
}

TEST_CASE("a step to where there are no residuals is shortened", "[fast]") {
  // The distance of log(u) to log(2) from far below: the first step goes to negative u.
  LeastSquaresProblem problem;
  problem.residuals = 1;
  int refused = 0;
  problem.evaluate = [&refused](const double* u, double* residuals, double* jacobian) {
    if (!(u[0] > 0.0)) {
      ++refused;
      return false;
    }
    residuals[0] = std::log(u[0]) - std::log(2.0);
    if (jacobian != nullptr) jacobian[0] = 1.0 / u[0];
    return true;
  };
  std::vector<double> unknowns{40.0};
  const LeastSquaresResult result = minimize_squares(problem, with(Factorization::kQr), unknowns);
  CHECK(refused > 0);
  CHECK(result.has_converged);
  CHECK(unknowns[0] == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("a search that may not go on says so, and what a residual throws ends it", "[fast]") {
  std::vector<double> unknowns{-1.2, 1.0};
  LeastSquaresOptions options = with(Factorization::kQr);
  options.most_iterations = 2;
  const LeastSquaresResult result = minimize_squares(make_rosenbrock(), options, unknowns);
  CHECK(result.is_usable);
  CHECK_FALSE(result.has_converged);
  CHECK_FALSE(result.message.empty());
  LeastSquaresProblem throwing = make_rosenbrock();
  throwing.evaluate = [](const double*, double*, double*) -> bool { throw std::domain_error("of the test"); };
  CHECK_THROWS_AS(minimize_squares(throwing, options, unknowns), std::domain_error);
}

TEST_CASE("searches in several threads find what one alone finds, to the bit", "[fast]") {
  std::vector<double> alone{-1.2, 1.0};
  minimize_squares(make_rosenbrock(), with(Factorization::kQr), alone);
  std::vector<std::vector<double>> found(4, {-1.2, 1.0});
  std::vector<std::thread> threads;
  for (std::vector<double>& unknowns : found) {
    threads.emplace_back([&unknowns] { minimize_squares(make_rosenbrock(), with(Factorization::kQr), unknowns); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& unknowns : found) CHECK(unknowns == alone);
}
