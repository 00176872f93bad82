#pragma once
/// SUNDIALS CVODES behind the Integrator interface. This header and the library that holds it show no
/// SUNDIALS symbol: Simbody brings an old SUNDIALS of its own, and the two must not meet.

#include <memory>

#include "sim/integrator_statistics.h"
#include "sim/ode_system.h"

#define ROLLRIG_EXPORT __attribute__((visibility("default")))

namespace rollrig::sim {

struct CvodesOptions {
  double relative_tolerance = 1e-6;
  /// Multiplies the relative and all absolute tolerances.
  double tolerance_factor = 1.0;
  int max_order = 5;
};

/// Variable-step BDF with dense difference Jacobian (sim/difference_jacobian.h); the integrals are quadratures under
/// error control; a stop condition is found as a root.
/// Errors    RunFailure with the time and the reason when the integration cannot go on
/// Checked   tests/sim/cvodes_integrator_test.cpp
class ROLLRIG_EXPORT CvodesIntegrator : public Integrator<double> {
 public:
  static constexpr const char* kName = "CVODES BDF";

  explicit CvodesIntegrator(OdeSystem<double>& system, const CvodesOptions& options = {});
  ~CvodesIntegrator() override;
  CvodesIntegrator(const CvodesIntegrator&) = delete;
  CvodesIntegrator& operator=(const CvodesIntegrator&) = delete;

  void begin_run(double time_s) override;
  void begin_segment(double max_step_s, const StopCondition* stop) override;
  bool step(double end_time_s) override;
  double time_s() const override;
  double* state() override;
  double* integrals() override;
  void interpolate_state(double time_s, double* state) override;
  void interpolate_integrals(double time_s, double* integrals) override;

  IntegratorStatistics statistics() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace rollrig::sim
