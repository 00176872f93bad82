#pragma once
/// What no named effect explains: a flexible function of time in every series, on several scales.

#include <vector>

#include "diagnosis/model.h"

namespace rollrig::diagnosis {

/// Size of the remainder by channel, in noise floors (standard deviation of a block's mean).
using Amplitudes = std::vector<double>;

/// A normal process in every series: hats of 120 s and of 480 s, a constant in each phase, a constant in the run, each
/// with a quarter of the variance. It stands for model error: small under every hypothesis, free under `unknown`.
///
/// Equation  covariance of the whitened residual  Sigma = 1 + a^2 B B^T, B the whitened basis in noise floors; with
///           B = U s V^T: Sigma^-1 = 1 - U diag(a^2 s^2/(1 + a^2 s^2)) U^T, |Sigma| = prod (1 + a^2 s^2)
/// Checked   tests/diagnosis/remainder_test.cpp
class Remainder {
 public:
  explicit Remainder(const PreparedSet& set);

  /// One series' basis: U and s^2.
  struct Basis {
    Eigen::MatrixXd directions;
    Eigen::VectorXd strengths;
  };
  const Basis& basis(std::size_t series) const { return bases_[series]; }
  const PreparedSet& set() const { return set_; }

  /// Multiplies whitened columns by Sigma^-1/2, in place.
  template <class Columns>
  void whiten(const Amplitudes& amplitudes, Columns& columns) const;

 private:
  const PreparedSet& set_;
  std::vector<Basis> bases_;
};

}  // namespace rollrig::diagnosis
