#pragma once
/// One-step integration for programs of many short segments: it keeps its order and its Jacobian over a knot.

#include <Eigen/Dense>
#include <vector>

#include "sim/difference_jacobian.h"
#include "sim/integrator_statistics.h"
#include "sim/ode_system.h"

namespace rollrig::sim {

struct RosenbrockOptions {
  double relative_tolerance = 1e-6;
  /// Multiplies the relative and all absolute tolerances.
  double tolerance_factor = 1.0;
  /// Multiplies the absolute tolerances, because the error test judges the embedded solution of order 2. Assumed: the
  /// solution of order 3, which is kept, has a twentieth of that error. Energies then close as well as with CVODES.
  double absolute_factor = 20.0;
};

/// Rosenbrock-W method ROS34PW2 (sim/rosenbrock_rule.h) with variable steps and four stages. Integrals take part by an
/// explicit rule of the same weights, and are under error control too.
///
/// Equation  k_i = h f(t + a_i h, y + sum_{j<i} a_ij k_j) + h A sum_{j<=i} g_ij k_j + h^2 g_i d, i = 1 .. 4;
///           y_{n+1} = y_n + sum b_i k_i; error sum (b_i - bl_i) k_i; a_i = sum_j a_ij, g_i = sum_j g_ij
/// Symbols   f rates [SI units/s], h step [s]; A an approximation of df/dy [1/s]: zero for integrals, and else a
///           difference Jacobian (sim/difference_jacobian.h) that is kept over many steps and knots; d an approximation
///           of df/dt: by a difference in the first step of a segment, then what A does not explain of the change of f
/// Validity  stiff systems. With A = df/dy the method is L-stable; a stiff rate may grow by 0.6 of itself while A is
///           kept, beyond which only the error test limits the step
/// Accuracy  order 3 for any A and d, at the ends of steps and between them (sim/hermite_cubic.h)
/// Errors    RunFailure with the time where rates are not finite or steps become too short to go on
/// Checked   tests/sim/rosenbrock_integrator_test.cpp
class RosenbrockIntegrator : public Integrator<double> {
 public:
  static constexpr const char* kName = "ROS34PW2";

  explicit RosenbrockIntegrator(OdeSystem<double>& system, const RosenbrockOptions& options = {});

  void begin_run(double time_s) override;
  void begin_phase() override;
  void begin_segment(double max_step_s, const StopCondition* stop) override;
  bool step(double end_time_s) override;
  double time_s() const override { return time_s_; }
  double* state() override { return y_.data(); }
  double* integrals() override { return y_.data() + n_; }
  void interpolate_state(double time_s, double* state) override;
  void interpolate_integrals(double time_s, double* integrals) override;

  const IntegratorStatistics& statistics() const { return statistics_; }

 private:
  using Vector = Eigen::VectorXd;

  Vector& stage(int i) { return u_[static_cast<std::size_t>(i)]; }
  bool evaluate(double time_s, const Vector& y, Vector& rates);
  void require_rates();
  void prepare_step(double left_s);
  void find_jacobian();
  void find_drift(double left_s);
  void follow_drift();
  static double fit_step(double h_s, double left_s);
  bool try_step(double h_s);
  bool find_stage(int i, double h_s);
  double calc_error() const;
  void advance(double h_s);
  void interpolate(double time_s, std::size_t first, std::size_t count, double* out);
  double distance_to_stop(double time_s, const double* state);
  void step_to_stop(double h_s);
  [[noreturn]] void fail(const char* why) const;

  OdeSystem<double>& system_;
  std::size_t n_;      // states
  std::size_t total_;  // states and integrals
  Vector tolerance_;
  double relative_tolerance_;

  double time_s_ = 0.0;
  double before_s_ = 0.0;          // start of the last step
  Vector y_, y_before_, y_trial_;  // states and integrals: now, at before_s_, at the end of a step that is tried
  Vector rate_, rate_before_;      // at y_ and y_before_
  bool has_rate_ = false;          // of y_, under the inputs of the segment
  Vector drift_;                   // of the rates of states, with time alone
  Vector argument_, rate_other_, error_;
  std::vector<Vector> u_;  // of the stages

  DifferenceJacobian differences_;
  Eigen::MatrixXd jacobian_;
  int jacobian_age_ = 0;     // in steps
  double jacobian_s_ = 0.0;  // time for which it was found
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  double factored_h_s_ = 0.0;  // step for which the factors are

  double next_h_s_ = 0.0;
  double first_h_s_ = 0.0;  // what a segment begins with
  bool is_first_ = false;   // step of the segment
  const StopCondition* stop_ = nullptr;
  IntegratorStatistics statistics_;
};

}  // namespace rollrig::sim
