#pragma once
/// Uncertainty by propagation of distributions (GUM Supplement 1), beside the budget.

#include <functional>
#include <vector>

#include "estimation/uncertainty/budget.h"

namespace rollrig::estimation {

/// Whether the interval of the GUM agrees with that of Monte Carlo.
enum class GumVerdict {
  kAgrees,
  kDiffers,
  kUndecided  // the scatter of the interval's ends over the trials is too large to tell
};

/// One result by Monte Carlo, SI.
struct MonteCarloResult {
  Measurand measurand;
  double mean = 0.0;
  double sd = 0.0;
  bool has_mean = true;  // not where a contribution has one degree of freedom
  bool has_sd = true;    // not where one has two or fewer
  double low = 0.0;      // interval of 95 %, 2.5 % of the trials beyond either end
  double high = 0.0;
  double low_sd = 0.0;  // how well the ends are known from so many trials
  double high_sd = 0.0;
  double gum_low = 0.0;  // the interval of the GUM
  double gum_high = 0.0;
  double tolerance = 0.0;       // of the comparison: half of the last of two digits of the combined uncertainty
  double low_difference = 0.0;  // of the ends from those of the GUM
  double high_difference = 0.0;
  GumVerdict verdict = GumVerdict::kUndecided;
  double trials_wanted = 0.0;  // with which the ends are known to a fifth of the tolerance
};

struct MonteCarlo {
  int trials = 0;
  int failed = 0;  // trials whose evaluation failed: they are in no result
  std::uint64_t seed = 0;
  std::vector<MonteCarloResult> results;  // in the order of the budgets
};

/// Draws the inputs of a model, evaluates it, and compares what comes out with the budgets. The same to the bit for any
/// number of threads. Throws Interrupted, and RunFailure where more than a tenth of the trials fail.
/// Equation  delta = 10^l / 2 with u(y) = c 10^l, c a whole number of two digits;
///           the GUM agrees where |y - U - y_low| <= delta and |y + U - y_high| <= delta
/// Validity  kFewestTrials trials at least. The ends have a standard deviation s of their own, by the order statistics
///           of the trials: "agrees" where the larger difference + 2 s is within delta, "differs" where it - 2 s is not
/// Source    JCGM 101:2008 7.2 to 7.7 (intervals with equal tails), 7.9.2 (delta), 8.1 (comparison), 8.2 (delta/5)
/// Checked   tests/estimation/uncertainty_test.cpp
MonteCarlo run_monte_carlo(const MeasurementModel& model, const std::vector<UncertaintyBudget>& budgets,
                           const UncertaintyRequest& request, const std::function<void(double)>& advance = {});

/// Half of the last of two significant digits of a standard uncertainty.
double calc_numerical_tolerance(double standard_uncertainty);

}  // namespace rollrig::estimation
