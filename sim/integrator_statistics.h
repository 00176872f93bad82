#pragma once
/// What an integrator with error control counts.

namespace rollrig::sim {

struct IntegratorStatistics {
  long steps = 0;
  long rate_evaluations = 0;  // of rates, those for Jacobians included
  long jacobian_evaluations = 0;
  long error_test_failures = 0;
};

}  // namespace rollrig::sim
