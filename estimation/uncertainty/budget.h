#pragma once
/// Uncertainty budgets by the GUM: what each input contributes, and the expanded uncertainty.

#include <functional>
#include <string>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"

namespace rollrig::estimation {

/// A line of a budget.
struct Contribution {
  UncertainInput input;
  double sensitivity = 0.0;   // dY/dX, SI
  double contribution = 0.0;  // |dY/dX| u(x), in the unit of the result, SI
  double share = 0.0;         // of the variance
  bool is_group = false;      // several inputs of one name: they have no value, uncertainty and sensitivity in common
};

struct UncertaintyBudget {
  Measurand measurand;
  double value = 0.0;
  std::vector<Contribution> contributions;  // in the order of the inputs
  double combined = 0.0;                    // combined standard uncertainty
  double degrees_freedom = 0.0;             // effective; infinity where all inputs have infinitely many
  double coverage_factor = 0.0;             // for a coverage of 95 %
  double expanded = 0.0;
};

/// The budget of each result of a model. `advance` gets the share that is done. Throws Interrupted, and RunFailure as
/// its evaluation does.
/// Equation  u^2(y) = sum c_i^2 u^2(x_i);  c_i u(x_i) = [f(x_i + u(x_i)) - f(x_i - u(x_i))] / 2
///           nu_eff = u^4(y) / sum (c_i u(x_i))^4 / nu_i;  U = t_0.975(nu_eff) u(y)
/// Symbols   c_i sensitivity coefficient; nu degrees of freedom, nu_eff at least 1 and not rounded. Inputs of one pool
///           have one nu_i, and count as one in the sum over nu
/// Validity  inputs independent, f nearly linear over +-u: Monte Carlo shows whether it is
/// Source    JCGM 100:2008 (GUM) 5.1.2, note 2 of 5.1.3, G.4.1, G.4.2
/// Checked   tests/estimation/uncertainty_test.cpp
std::vector<UncertaintyBudget> calc_budgets(const MeasurementModel& model,
                                            const std::function<void(double)>& advance = {});

/// t_p of Student's t for a two-sided coverage of 95 %, also between whole numbers of degrees of freedom (G.4.1); 1.960
/// for infinitely many.
double calc_coverage_factor(double degrees_freedom);

}  // namespace rollrig::estimation
