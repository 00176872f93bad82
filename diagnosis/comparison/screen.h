#pragma once
/// Which terms could explain what the baseline leaves, to first order in their size.

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// One term at the best of a few shapes.
struct Screened {
  SignedTerm term;
  Eigen::VectorXd own;         // prior units: where a refit should start
  double score = 0.0;          // gain in -chi2/2 for the best size of the right sign
  double detectability = 0.0;  // d': size of the signature at the middle of its prior, in standard deviations
  double tried_u = 0.0;        // size that was tried, in prior units,
  double along = 0.0;          // and the score s of its signature
  bool was_simulated = true;   // not where the fit, which makes up for it, leaves no room: nothing is known of it then
};

/// The unknowns of `fit` with a term's own put in at its place among the terms of the larger hypothesis.
Eigen::VectorXd insert_own(const Model& larger, const Fit& fit, const Term& term, const Eigen::VectorXd& own);

/// Tries every term on top of `from`, with a finite size, so that those without a first order are seen too:
/// signature g = difference at the middle of the prior and, one at a time, one prior unit off in each shape.
/// Equation  z = s/sqrt(V), best size = s/V middles, s and V score and variance of g (linear_fit.h); score = z^2/2
///           where the sign is one that the term may have; d' = sqrt(V)
/// A term that cannot be simulated on top of the fit at all is listed without a score
std::vector<Screened> screen(const Study& study, const Candidate& from, const std::vector<const Term*>& terms);

}  // namespace rollrig::diagnosis
