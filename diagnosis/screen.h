#pragma once
/// Which effects could explain what the baseline leaves, to first order in their size.

#include <Eigen/Cholesky>

#include "diagnosis/evidence.h"
#include "diagnosis/refit.h"

namespace rollrig::diagnosis {

/// One effect at the best of a few shapes.
struct Screened {
  ActingEffect effect;
  Eigen::VectorXd own;         // prior units: where a refit should start
  double score = 0.0;          // gain in -chi2/2 for the best size of the right sign
  double detectability = 0.0;  // d': size of the signature at the middle of its prior, in standard deviations
  Eigen::VectorXd signature;   // whitened, with everything projected out that the base and offsets can take
};

/// Everything linear about a fit that an added signature is judged by.
class LinearJudge {
 public:
  LinearJudge(const Remainder& remainder, const Amplitudes& amplitudes, const Fit& fit);
  /// Sigma^-1/2 of a difference of block means, less what the fit's own unknowns can take of it.
  Eigen::VectorXd project(Eigen::VectorXd difference) const;
  const Eigen::VectorXd& residual() const { return residual_; }

 private:
  const Remainder& remainder_;
  Amplitudes amplitudes_;
  RowMatrix jacobian_;
  Eigen::LLT<Eigen::MatrixXd> curvature_;
  Eigen::VectorXd residual_;
};

/// The unknowns of `fit` with an effect's own put in at its place among the larger hypothesis's effects.
Eigen::VectorXd insert_own(const Model& larger, const Fit& fit, const models::Effect& effect,
                           const Eigen::VectorXd& own);

/// Tries every effect on top of `fit`, with a finite size, so that effects without a first order are seen too:
/// signature g = difference at the middle of the prior and, one at a time, one prior unit off in each shape.
/// Equation  z = g.r/|g|, best size = g.r/g.g middles; score = z^2/2 where the sign is one that the effect may have
/// Effects   whose simulation fails are left out
std::vector<Screened> screen(const Model& null, const Remainder& remainder, const Amplitudes& amplitudes,
                             const Fit& fit, const std::vector<identification::FreeParameter>& base,
                             const std::vector<const models::Effect*>& effects, int threads);

}  // namespace rollrig::diagnosis
