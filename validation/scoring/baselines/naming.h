#pragma once
/// The baselines that name effects. Each sees a set as LinearData and nothing else.

#include <map>
#include <string>
#include <vector>

#include "validation/scoring/baselines/linear_data.h"

namespace rollrig::validation {

/// What a method makes of a set.
struct Naming {
  std::vector<std::size_t> chosen;            // signatures, the strongest first; none: no gap
  std::map<std::string, double> probability;  // of "none", "unknown" and every effect
  double named_probability = 0.0;             // of the named effects together, or of "none"
};

/// Effects of the chosen signatures, each once; the first three, since a larger set names nothing.
std::vector<std::string> find_named(const LinearData& data, const std::vector<std::size_t>& chosen);

/// A set of signatures that was fitted, and how it is rated: the less the better.
struct CandidateModel {
  std::vector<std::size_t> columns;
  double criterion = 0.0;
};
/// Whether `a` is the better one.
inline bool operator<(const CandidateModel& a, const CandidateModel& b) { return a.criterion < b.criterion; }

/// Probabilities by the weights of Akaike or Schwarz; an effect has those of all models that contain it.
/// Equation  w_i = exp(-(c_i - c_best)/2) / sum
/// Symbols   c criterion
/// Source    Burnham and Anderson, Model Selection and Multimodel Inference, 2nd ed. (2002), section 2.9
Naming weigh(const LinearData& data, const std::vector<CandidateModel>& models, std::vector<std::size_t> chosen);

/// Residual analysis: the effect whose signature points where the residual does.
/// Equation  cos = g.r/(|g| |r|); explains chi2 (g.r)^2/|g|^2, where g.r > 0; no gap where |r|^2 is not beyond the
///           99 % quantile of chi2 with as many degrees of freedom as blocks. Probabilities by exp(chi2/2) of what each
///           explains share what that test leaves: 99 % or 1 %
/// Symbols   r residual, g signature
/// Source    Gertler, Fault Detection and Diagnosis in Engineering Systems (1998), directional residuals
Naming name_by_nearest_signature(const LinearData& data);

/// Forward selection: the effect that lowers the criterion most is added until none lowers it. Amplitudes below 0 are
/// refused.
/// Equation  criterion = chi2 of least squares + penalty times the number of effects
/// Source    Akaike, IEEE Trans. Autom. Control 19 (1974) 716; Schwarz, Ann. Stat. 6 (1978) 461
Naming name_by_forward_selection(const LinearData& data, double penalty);
Naming name_by_aic(const LinearData& data);  // penalty 2
Naming name_by_bic(const LinearData& data);  // ln of the number of blocks

/// Sparse regression of the discrepancy: LASSO by coordinate descent along a path of penalties, no amplitude below 0;
/// of the sets of effects on the path the one of least BIC, each fitted by least squares.
/// Equation  least |r - G a|^2/2 + lambda sum a, a >= 0, columns of G of unit length;
///           a_j <- max(0, g_j.(r - sum over k != j of g_k a_k) - lambda)
/// Source    Tibshirani, J. R. Stat. Soc. B 58 (1996) 267; Friedman, Hastie, Tibshirani, J. Stat. Softw. 33 (2010) 1;
///           least squares on the path's sets: Efron et al., Ann. Stat. 32 (2004) 407, "LARS-OLS hybrid"
Naming name_by_sparse_regression(const LinearData& data);

// Checked  tests/validation/scoring/baselines_test.cpp: all of the above

}  // namespace rollrig::validation
