#pragma once
/// How well a hypothesis predicts a set, all its parameters and its model error integrated out.

#include <Eigen/Cholesky>
#include <vector>

#include "diagnosis/comparison/refit.h"

namespace rollrig::diagnosis {

/// What a hypothesis holds of the discrepancy's amplitude in one channel: weights, adding to 1, of amplitudes.
struct AmplitudePrior {
  std::vector<double> amplitudes;  // noise floors
  std::vector<double> weights;
};

/// Log-normal around a middle, on a grid of factors of two.
AmplitudePrior near_amplitude(double middle);

/// Likewise, and with `kExactLaw` of the weight at smaller amplitudes, in factors of four down to `least`: `middle`
/// grows with the effect, and of a huge effect it overstates what a good law leaves.
AmplitudePrior law_amplitude(double least, double middle);

/// Evidence of a hypothesis linear about an expansion point.
/// Equation  Z = sum over amplitudes of w |Sigma|^-1/2 |M|^-1/2 exp(-chi2/2) prod_i P_i/P0_i,
///           M = 1 + J^T Sigma^-1 J, g = u + J^T Sigma^-1 r, chi2 = r^T Sigma^-1 r + u^T u - g^T M^-1 g
/// Symbols   r whitened residual at the unknowns u (prior units), J its derivatives, Sigma of the discrepancy;
///           P_i probability that own parameter i lies within its allowed range, after the measurement, P0_i before it;
///           constants that all hypotheses share are left out
/// Validity  one own parameter at most is held back by its range; of several the product is an approximation
/// Source    Laplace's method with a normal prior of unit variance that is cut off at the allowed range
/// Checked   tests/diagnosis/evidence_test.cpp
class Evidence {
 public:
  Evidence(const Discrepancy& discrepancy, const Fit& fit);

  /// Under one combination of amplitudes, one a channel.
  struct Solution {
    double log_value = 0.0;
    Eigen::VectorXd step;        // to the best unknowns
    Eigen::MatrixXd covariance;  // of the unknowns; where asked for
    double chi2 = 0.0;
  };
  Solution solve(const Amplitudes& amplitudes, bool with_covariance = false) const;

  struct Sum {
    double log_value = 0.0;
    Amplitudes mean;  // of the amplitudes, after the measurement
  };
  /// Over all combinations of the channels' amplitudes.
  Sum integrate(const std::vector<AmplitudePrior>& priors) const;

 private:
  /// Sums over data of J^T Sigma^-1 J, J^T Sigma^-1 r, r^T Sigma^-1 r and log |Sigma|.
  struct Sums {
    Eigen::MatrixXd curvature;
    Eigen::VectorXd gradient;
    double square = 0.0;
    double log_determinant = 0.0;

    Sums& operator+=(const Sums& other);
  };
  Sums make_empty() const;
  Sums sum_channel(std::size_t channel, double amplitude) const;
  Solution solve(const Sums& sums, bool with_covariance) const;

  /// ln of the product of P_i/P0_i.
  double calc_log_within(const Eigen::LLT<Eigen::MatrixXd>& factor, const Eigen::VectorXd& step) const;

  const Discrepancy& discrepancy_;
  Eigen::VectorXd unknowns_;
  std::vector<PriorBounds> own_bounds_;
  double log_determinant_below_ = 0.0;
  struct Part {                 // of a basis
    Eigen::MatrixXd curvature;  // J^T J
    Eigen::VectorXd gradient;   // J^T r
    double square = 0.0;        // r^T r
    Eigen::MatrixXd along;      // U^T J
    Eigen::VectorXd along_residual;
  };
  std::vector<Part> parts_;
};

/// A free discrepancy: either as small as model error, or of any size up to a hundred floors.
AmplitudePrior free_amplitude(double smallest);

/// ln of the sum of the numbers whose logarithms these are.
double log_sum_exp(const std::vector<double>& logs);

}  // namespace rollrig::diagnosis
