// Nonlinear least squares within bounds.
#include "estimation/least_squares/least_squares.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
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
