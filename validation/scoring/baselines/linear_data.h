#pragma once
/// What the baselines see of a set: how the measurement differs from the simulator, and how each effect would look.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/comparison/model.h"

namespace rollrig::validation {

/// Whitened by the sensors and by what the base parameters and offsets can do within their priors: where there is no
/// gap the residual is independent and of unit variance. A signature is what an effect adds to the residual at some
/// size that it may have; its amplitude is not below 0.
struct LinearData {
  Eigen::VectorXd residual;          // measured minus the baseline as calibrated
  Eigen::MatrixXd signatures;        // a column each
  std::vector<std::string> effects;  // of the columns; one of either sign has two
};

/// Takes out of whitened columns what unknowns with standard normal priors can do.
/// Equation  C^-1/2 = 1 - U diag(1 - 1/sqrt(1 + s^2)) U^T, C = 1 + J J^T, J = U s V^T
/// Symbols   J derivatives by base parameters and offsets, in prior units
/// Source    generalized least squares with normal priors: ridge regression, kept in
/// Checked   tests/validation/scoring/baselines_test.cpp
class BaseProjection {
 public:
  explicit BaseProjection(const diagnosis::RowMatrix& jacobian);
  Eigen::MatrixXd apply(const Eigen::MatrixXd& columns) const;

 private:
  Eigen::MatrixXd directions_;  // U
  Eigen::VectorXd taken_;
};

/// Least squares of the residual by some signatures.
class LeastSquares {
 public:
  explicit LeastSquares(const LinearData& data);

  struct Fit {
    Eigen::VectorXd amplitudes;  // in the order of the columns
    Eigen::VectorXd sd;
    double chi2 = 0.0;
  };
  /// Of signatures that are the same each has its share.
  Fit fit(const std::vector<std::size_t>& columns) const;

  // Of the signatures scaled to unit length.
  const Eigen::MatrixXd& products() const { return products_; }  // with one another
  const Eigen::VectorXd& along() const { return along_; }        // with the residual
  double chi2() const { return chi2_; }                          // of the residual

 private:
  Eigen::VectorXd lengths_;
  Eigen::MatrixXd products_;
  Eigen::VectorXd along_;
  double chi2_;
};

}  // namespace rollrig::validation
