#pragma once
/// Generalized least squares when the sizes of several kinds of scatter have to be found from the data.

#include <vector>

#include <Eigen/Core>

namespace rollrig::estimation {

/// Observations that share scatter with each other and with no others: a run.
struct LinearBlock {
  Eigen::VectorXd y;
  Eigen::MatrixXd X;
  std::vector<Eigen::MatrixXd> patterns;  // covariance per unit of each component
};

struct LinearEstimate {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd components;       // variances, not negative
  Eigen::VectorXd degrees_freedom;  // of each coefficient's variance (Satterthwaite)
  std::vector<bool> decided;        // whether the data decide the component at all
  double chi2 = 0.0;                // of the residuals, weighted by the covariance found
  double log_likelihood = 0.0;      // restricted, at the components given to the step, without its constant
};

/// By how much the log likelihood with sessions that differ by a share of the force has to be above that with the same
/// force at all speeds, to be taken. Assumed: log 20; the temperature of tires often differs, which is a constant force
constexpr double kClearlyMoreLikely = 3.0;

/// Blocks as one, without scatter between them.
LinearBlock join_blocks(const std::vector<LinearBlock>& parts);

/// One step towards the restricted maximum likelihood, and the estimate there.
/// Equation  V = sum s_i V_i;  beta = (X'WX)^-1 X'W y,  W = V^-1;  sum_j tr(P V_i P V_j) s_j = y'P V_i P y,
///           P = W - W X (X'WX)^-1 X'W;  degrees of freedom 2 var^2 / Var(var);
///           restricted log likelihood -(log|V| + log|X'WX| + y'P y)/2
/// Symbols   s_i component of variance, `floors` its least value; V_i pattern
/// Validity  normal scatter; components that come out negative are set to their floor
/// Source    Harville 1977 (restricted likelihood, scoring); Fai and Cornelius 1996 (degrees of freedom)
/// Checked   tests/estimation/variance_components_test.cpp
LinearEstimate step_variance_components(const std::vector<LinearBlock>& blocks, const Eigen::VectorXd& components,
                                        const Eigen::VectorXd& floors);

/// The estimate with given components.
LinearEstimate solve_weighted(const std::vector<LinearBlock>& blocks, const Eigen::VectorXd& components);

/// Minimum of the quadratic form of an estimate within bounds on its first coefficients; those that end on a
/// bound get no variance.
void apply_bounds(LinearEstimate& estimate, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace rollrig::estimation
