#pragma once
/// The uncertainty of the difference of two results that both have a budget.

#include <string>
#include <vector>

#include "sim/core/json.h"

namespace rollrig::comparison {

/// How the errors of an input of two results go together.
enum class Relation {
  kCommon,      // one error: the same instrument, or the same tire file
  kIndependent  // an error of each
};

/// Which inputs two runs share.
struct SharedInputs {
  bool is_same_run = false;  // all inputs and the seed are equal: the results are one
  bool has_one_machine = false;
  bool has_one_tire = false;

  /// Errors that are drawn anew in each test, of type A or "noise and drift", are independent; numbers of the tire file
  /// are common where the tire is the same, all others where the machine is.
  Relation find(const Json& contribution) const;
};

struct DifferenceUncertainty {
  double sd = 0.0;
  double coverage_factor = 0.0;
};

/// Of two budgets as result.json has them, `uncertainty.budgets[]`. An input that only one budget has is independent.
/// Equation  u^2(d) = sum_common (c_B u_B - c_A u_A)^2 + sum_independent [(c_A u_A)^2 + (c_B u_B)^2]
///           nu_eff = u^4 / sum (u_i^4 / nu_i)
/// Symbols   c u contribution with the sign of its sensitivity; a line of several inputs has none, and counts as positive
/// Validity  correlation coefficients of 1 and 0 alone
/// Source    JCGM 100:2008 (GUM) 5.2.2 with r = 1 and r = 0, G.4.1
/// Checked   tests/comparison/budget_difference_test.cpp
DifferenceUncertainty calc_difference_uncertainty(const Json& reference, const Json& other, const SharedInputs& shared);

/// Names of inputs with a contribution that are taken to be common, and those taken to be independent.
struct InputNames {
  std::vector<std::string> common;
  std::vector<std::string> independent;
};
InputNames name_inputs(const Json& reference, const Json& other, const SharedInputs& shared);

}  // namespace rollrig::comparison
