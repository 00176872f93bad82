#include "sim/rosenbrock_integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "sim/core/error.h"
#include "sim/hermite_cubic.h"
#include "sim/rosenbrock_rule.h"

namespace rollrig::sim {
namespace {

const RosenbrockRule& rule() {
  static const RosenbrockRule kRule;
  return kRule;
}

// A Jacobian is found anew after so many steps or seconds. Assumed: within 5 s a vehicle changes its speed by some 3
// m/s.
constexpr int kOldest_steps = 20;
constexpr double kOldest_s = 5.0;
constexpr double kFirstStep_s = 1e-3;  // Assumed: first step of a run

/// Factor on a step that would bring its error to 1, what is tolerated. The error grows with the third power of the
/// step.
double find_step_factor(double error, double least, double most) {
  constexpr double kSafety = 0.9;
  if (!std::isfinite(error)) return least;
  return std::clamp(kSafety / std::cbrt(std::max(error, 1e-12)), least, most);
}

}  // namespace

RosenbrockIntegrator::RosenbrockIntegrator(OdeSystem<double>& system, const RosenbrockOptions& options)
    : system_(system),
      n_(system.state_count()),
      total_(n_ + system.integrals().size()),
      differences_(system.state_tolerances()) {
  const auto size = static_cast<Eigen::Index>(total_);
  for (Vector* v :
       {&y_, &y_before_, &y_trial_, &argument_, &error_, &rate_, &rate_before_, &rate_other_, &tolerance_}) {
    v->setZero(size);
  }
  u_.assign(RosenbrockRule::kStages, Vector::Zero(size));
  const auto n = static_cast<Eigen::Index>(n_);
  jacobian_.setZero(n, n);
  drift_.setZero(n);
  const std::vector<double> states = system.state_tolerances();
  for (std::size_t i = 0; i < total_; ++i) {
    const double absolute = i < n_ ? states[i] : system.integrals()[i - n_].tolerance_SI;
    tolerance_[static_cast<Eigen::Index>(i)] = options.tolerance_factor * options.absolute_factor * absolute;
  }
  relative_tolerance_ = options.relative_tolerance * options.tolerance_factor;
}

void RosenbrockIntegrator::begin_run(double time_s) {
  time_s_ = before_s_ = time_s;
  y_.setZero();
  jacobian_age_ = kOldest_steps;
  first_h_s_ = kFirstStep_s;
}

/// The commands of a phase change the Jacobian: without a driver, the stiffness of his control is gone.
void RosenbrockIntegrator::begin_phase() { jacobian_age_ = kOldest_steps; }

void RosenbrockIntegrator::begin_segment(double, const StopCondition* stop) {
  stop_ = stop;
  has_rate_ = false;
  is_first_ = true;
  next_h_s_ = first_h_s_;
}

bool RosenbrockIntegrator::evaluate(double time_s, const Vector& y, Vector& rates) {
  system_.evaluate(time_s, y.data(), rates.data(), rates.data() + n_);
  ++statistics_.rate_evaluations;
  return rates.allFinite();
}

bool RosenbrockIntegrator::step(double end_time_s) {
  if (stop_ != nullptr && distance_to_stop(time_s_, y_.data()) <= 0.0) return true;
  const double left_s = end_time_s - time_s_;
  prepare_step(left_s);
  double h_s = fit_step(next_h_s_, left_s);
  int failures = 0;
  while (!try_step(h_s)) {
    h_s = fit_step(h_s * find_step_factor(calc_error(), 0.1, 0.7), left_s);
    ++failures;
    ++statistics_.error_test_failures;
    if (failures == 2 && jacobian_age_ > 0) {
      jacobian_age_ = kOldest_steps;
      prepare_step(left_s);
    }
    if (h_s < 1e-13 * std::max(1.0, std::abs(time_s_))) fail("steps become too short to go on");
  }
  const double error = calc_error();
  if (is_first_) first_h_s_ = h_s * find_step_factor(error, 0.2, failures > 0 ? 1.0 : 5.0);
  next_h_s_ = h_s * find_step_factor(error, 0.2, 6.0);
  is_first_ = false;
  const bool is_met = stop_ != nullptr && distance_to_stop(time_s_ + h_s, y_trial_.data()) <= 0.0;
  if (is_met) {
    step_to_stop(h_s);
  } else {
    advance(h_s);
    if (h_s == left_s) time_s_ = end_time_s;
  }
  ++jacobian_age_;
  ++statistics_.steps;
  return is_met;
}

/// Rates, Jacobian and drift at y_.
void RosenbrockIntegrator::prepare_step(double left_s) {
  require_rates();
  if (jacobian_age_ >= kOldest_steps || time_s_ - jacobian_s_ > kOldest_s) find_jacobian();
  if (is_first_) {
    find_drift(left_s);
  } else {
    follow_drift();
  }
}

void RosenbrockIntegrator::fail(const char* why) const {
  throw RunFailure(
      fmt::format("integration failed at t = {} s: {}; the last good state is that of this time", time_s_, why));
}

/// The step, or as much as is left. Where one step and a short rest would remain, two equal steps.
double RosenbrockIntegrator::fit_step(double h_s, double left_s) {
  if (h_s >= left_s) return left_s;
  return std::min(h_s, 0.5 * left_s);
}

/// A step from y_ to y_trial_; false where its error is too large.
bool RosenbrockIntegrator::try_step(double h_s) {
  const RosenbrockRule& r = rule();
  if (factored_h_s_ != h_s) {
    Eigen::MatrixXd matrix = -jacobian_;
    matrix.diagonal().array() += 1.0 / (h_s * RosenbrockRule::kGamma);
    factors_.compute(matrix);
    factored_h_s_ = h_s;
  }
  y_trial_ = y_;
  error_.setZero();
  for (int i = 0; i < RosenbrockRule::kStages; ++i) {
    if (!find_stage(i, h_s)) {
      error_.setConstant(std::numeric_limits<double>::infinity());
      return false;
    }
    y_trial_ += r.weight[i] * stage(i);
    error_ += r.error[i] * stage(i);
  }
  return calc_error() <= 1.0;
}

/// u_i of a step; false where rates are not finite.
bool RosenbrockIntegrator::find_stage(int i, double h_s) {
  const RosenbrockRule& r = rule();
  const auto n = static_cast<Eigen::Index>(n_);
  Vector& u = stage(i);
  if (i == 0) {
    u = rate_;
  } else {
    argument_ = y_;
    for (int j = 0; j < i; ++j) argument_ += r.argument(i, j) * stage(j);
    if (!argument_.allFinite() || !evaluate(time_s_ + r.time[i] * h_s, argument_, u)) return false;
    for (int j = 0; j < i; ++j) u += r.coupling(i, j) / h_s * stage(j);
  }
  u.head(n) += h_s * r.drift[i] * drift_;
  u.head(n) = factors_.solve(u.head(n)).eval();
  u.tail(u.size() - n) *= h_s * RosenbrockRule::kGamma;
  return true;
}

/// Of states and of integrals the root mean square over what is tolerated; the larger of the two.
double RosenbrockIntegrator::calc_error() const {
  double states = 0.0, integrals = 0.0;
  for (std::size_t i = 0; i < total_; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double weight = tolerance_[at] + (i < n_ ? relative_tolerance_ * std::abs(y_[at]) : 0.0);
    const double share = error_[at] / weight;
    (i < n_ ? states : integrals) += share * share;
  }
  return std::sqrt(std::max(states / static_cast<double>(std::max<std::size_t>(n_, 1)),
                            integrals / static_cast<double>(std::max<std::size_t>(total_ - n_, 1))));
}

void RosenbrockIntegrator::advance(double h_s) {
  std::swap(y_, y_before_);
  std::swap(y_, y_trial_);
  std::swap(rate_, rate_before_);
  before_s_ = time_s_;
  time_s_ += h_s;
  has_rate_ = false;
}

/// The drift at the start of a segment: df/dt by a difference.
void RosenbrockIntegrator::find_drift(double left_s) {
  const double by_s = std::min(0.1 * left_s, 0.01);
  const auto n = static_cast<Eigen::Index>(n_);
  if (evaluate(time_s_ + by_s, y_, rate_other_)) {
    drift_ = (rate_other_.head(n) - rate_.head(n)) / by_s;
  } else {
    drift_.setZero();
  }
}

/// The drift after a step: what the Jacobian leaves unexplained of the change of the rates, without another evaluation.
void RosenbrockIntegrator::follow_drift() {
  const auto n = static_cast<Eigen::Index>(n_);
  drift_ = (rate_.head(n) - rate_before_.head(n) - jacobian_ * (y_ - y_before_).head(n)) / (time_s_ - before_s_);
}

void RosenbrockIntegrator::find_jacobian() {
  ++statistics_.jacobian_evaluations;
  factored_h_s_ = 0.0;
  differences_.fill(y_.data(), rate_.data(), jacobian_.data(), [this](const double* y, double* rates) {
    system_.evaluate(time_s_, y, rates, nullptr);
    ++statistics_.rate_evaluations;
  });
  if (!jacobian_.allFinite()) fail("rates near the state are not finite");
  jacobian_age_ = 0;
  jacobian_s_ = time_s_;
}

/// Rates at y_, under the inputs of the segment: at a knot there are those before it, and those after it.
void RosenbrockIntegrator::require_rates() {
  if (has_rate_) return;
  if (!evaluate(time_s_, y_, rate_)) fail("rates are not finite");
  has_rate_ = true;
}

void RosenbrockIntegrator::interpolate(double time_s, std::size_t first, std::size_t count, double* out) {
  if (time_s >= time_s_) {
    std::copy(y_.data() + first, y_.data() + first + count, out);
    return;
  }
  require_rates();
  const HermiteCubic cubic((time_s - before_s_) / (time_s_ - before_s_), time_s_ - before_s_);
  for (std::size_t k = 0; k < count; ++k) {
    const auto i = static_cast<Eigen::Index>(first + k);
    out[k] = cubic.interpolate(y_before_[i], y_[i], rate_before_[i], rate_[i]);
  }
}

void RosenbrockIntegrator::interpolate_state(double time_s, double* state) { interpolate(time_s, 0, n_, state); }

void RosenbrockIntegrator::interpolate_integrals(double time_s, double* integrals) {
  interpolate(time_s, n_, total_ - n_, integrals);
}

double RosenbrockIntegrator::distance_to_stop(double time_s, const double* state) {
  return stop_->find_distance(system_.watch(stop_->watch, time_s, state));
}

/// After a step of h_s would have gone beyond the stop condition: the step at whose end it is just met. To interpolate
/// inside a long step would close energies less well.
void RosenbrockIntegrator::step_to_stop(double h_s) {
  const auto distance = [&](double by_s) {
    if (!try_step(by_s) && !std::isfinite(calc_error())) fail("rates are not finite");
    return distance_to_stop(time_s_ + by_s, y_trial_.data());
  };
  std::uintmax_t most = 100;
  const boost::math::tools::eps_tolerance<double> exact(45);
  const auto bracket = boost::math::tools::toms748_solve(distance, 0.0, h_s, distance_to_stop(time_s_, y_.data()),
                                                         distance_to_stop(time_s_ + h_s, y_trial_.data()), exact, most);
  if (most >= 100) fail("the time of the stop condition was not found");
  distance(bracket.second);
  advance(bracket.second);
}

}  // namespace rollrig::sim
