#pragma once
/// Nonlinear least squares with bounds, by Ceres.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace rollrig::estimation {

/// Least sum of squares of residuals over unknowns.
///
/// Symbols  evaluate  computes the residuals r_i(u) and, where `jacobian` is not null, dr_i/du_j row by row. Returns
///                    false where they cannot be computed: the step is then shortened. An exception ends the search.
///          lower, upper  bounds of the first unknowns; infinite where there is none
///          follow        called after each iteration, from 0 in each search, with sum r_i^2 / 2 and the largest
///                        absolute component of its gradient; may be empty
struct LeastSquaresProblem {
  std::size_t residuals = 0;
  std::function<bool(const double* unknowns, double* residuals, double* jacobian)> evaluate;
  std::vector<double> lower;
  std::vector<double> upper;
  std::function<void(int iteration, double half_sum, double largest_gradient)> follow;
};

/// How each step is found, and when the search ends. The tolerances and their defaults are those of Ceres:
/// function_tolerance and parameter_tolerance are relative, gradient_tolerance is absolute.
struct LeastSquaresOptions {
  enum class Factorization { kQr, kNormalCholesky };
  Factorization factorization = Factorization::kQr;
  int most_iterations = 50;    // of each search
  int most_invalid_steps = 5;  // one after the other, each shorter than the one before
  double function_tolerance = 1e-6;
  double gradient_tolerance = 1e-10;
  double parameter_tolerance = 1e-8;
};

struct LeastSquaresResult {
  bool is_usable = false;  // the unknowns are no worse than the first ones
  bool has_converged = false;
  double half_sum = 0.0;  // of squares, at the unknowns
  std::string message;    // why the search ended
};

/// The unknowns at the least sum of squares, by Levenberg and Marquardt from `unknowns`, which are moved there.
/// Equation  minimum of sum r_i(u)^2 / 2 with lower <= u <= upper
/// Validity  a local minimum within the bounds. A search of Ceres may get stuck where an unknown reaches its bound: the
///           unknown is then held, and the others are searched again, until no bound holds one that should leave it.
///           May be called from several threads
/// Errors    RunFailure: the library cannot be loaded; what `evaluate` throws
/// Source    Ceres Solver 2.1: Trust Region Methods
/// Checked   tests/estimation/least_squares_test.cpp
LeastSquaresResult minimize_squares(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
                                    std::vector<double>& unknowns);

}  // namespace rollrig::estimation
