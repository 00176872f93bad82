#pragma once
/// A Gaussian process of the discrepancy: how far a black box without any cause shrinks the gap.

#include <Eigen/Core>

#include "diagnosis/comparison/prepared_set.h"

namespace rollrig::validation {

/// Regression with a squared-exponential kernel about 0. One factor for all length scales and the size of the signal
/// are those of largest likelihood, on a grid; the noise is known.
///
/// Equation  K(x, x') = s^2 exp(-|x - x'|^2/(2 f^2));  prediction K(x, X) (K + N)^-1 y;
///           ln p = -(y^T (K + N)^-1 y + ln |K + N|)/2
/// Symbols   X, y what was seen; N covariance of its noise; s size, f factor
/// Source    Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), equations 2.25 and 5.8
/// Checked   tests/validation/scoring/gaussian_process_test.cpp
class GaussianProcess {
 public:
  /// Rows of inputs in length scales; values and noise in noise floors.
  GaussianProcess(Eigen::MatrixXd inputs, const Eigen::VectorXd& values, const Eigen::MatrixXd& noise);
  Eigen::VectorXd predict(const Eigen::MatrixXd& inputs) const;

 private:
  Eigen::MatrixXd inputs_;
  double factor_ = 1.0;
  Eigen::VectorXd weights_;  // s^2 (K + N)^-1 y
};

/// The discrepancy of one run less what a process that learned it on the other runs predicts for it, channel by
/// channel. Inputs: time in the run, speed, load, air temperature. Noise: one floor, and the offset of the sensor's
/// session.
Eigen::VectorXd subtract_gaussian_process(const diagnosis::PreparedSet& set, const Eigen::VectorXd& difference,
                                          std::size_t run);

}  // namespace rollrig::validation
