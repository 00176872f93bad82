#pragma once
/// Classical Runge-Kutta of order 4 on a grid that depends on the program alone, so that results are smooth functions
/// of the parameters and can carry derivatives. Another rule on that grid derives from it and overrides begin(),
/// advance_to() and interpolate_step().

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <boost/math/tools/roots.hpp>

#include "sim/core/scalar.h"
#include "sim/hermite_cubic.h"
#include "sim/ode_system.h"

namespace rollrig::sim {

/// Equation  y_{n+1} = y_n + h/6 (k1 + 2 k2 + 2 k3 + k4); between grid points the cubic through values
///           and rates at both ends
/// Accuracy  order 4 in the state at the grid, order 4 in the state between, order 3 in the rate of an
///           integral between
/// Checked   tests/sim/fixed_grid_integrator_test.cpp
template <class S>
class FixedGridIntegrator : public Integrator<S> {
 public:
  explicit FixedGridIntegrator(OdeSystem<S>& system)
      : system_(system), n_(system.state_count()), m_(system.integrals().size()), total_(n_ + m_) {
    for (auto* v : {&y_, &y_before_, &rate_, &rate_before_, &k2_, &k3_, &k4_, &stage_}) v->resize(total_);
  }

  void begin_run(double time_s) override {
    time_s_ = time_s;
    std::fill(y_.begin(), y_.end(), zero<S>());
  }

  void begin_segment(double max_step_s, const StopCondition* stop) override {
    max_step_s_ = max_step_s;
    stop_ = stop;
    begin();
  }

  bool step(double end_time_s) override {
    const double left_s = end_time_s - time_s_;
    const double steps_left = std::max(1.0, std::ceil(left_s / max_step_s_ - 1e-9));
    const double target_s = steps_left > 1.0 ? time_s_ + left_s / steps_left : end_time_s;
    before_s_ = time_s_;
    std::swap(y_, y_before_);
    std::swap(rate_, rate_before_);
    advance_to(target_s);
    if (stop_ == nullptr) return false;
    return stop_inside_step();
  }

  double time_s() const override { return time_s_; }
  S* state() override { return y_.data(); }
  S* integrals() override { return y_.data() + n_; }

  void interpolate_state(double time_s, S* state) override { interpolate(time_s, 0, n_, state); }
  void interpolate_integrals(double time_s, S* integrals) override { interpolate(time_s, n_, total_, integrals); }

 protected:
  using Vector = std::vector<S>;

  /// At the start of a segment, from y_ at time_s_.
  virtual void begin() { evaluate(time_s_, y_, rate_); }

  /// One step from y_before_ at before_s_, whose rate is rate_before_, and the rate at its end, or one that interpolates
  /// as well.
  virtual void advance_to(double target_s) {
    step_classically(target_s);
    evaluate(target_s, y_, rate_);
  }

  void step_classically(double target_s) {
    const double h_s = target_s - before_s_;
    const double middle_s = before_s_ + 0.5 * h_s;
    add_scaled(0.5 * h_s, rate_before_);
    evaluate(middle_s, stage_, k2_);
    add_scaled(0.5 * h_s, k2_);
    evaluate(middle_s, stage_, k3_);
    add_scaled(h_s, k3_);
    evaluate(target_s, stage_, k4_);
    for (std::size_t i = 0; i < total_; ++i) {
      y_[i] = y_before_[i] + (h_s / 6.0) * (rate_before_[i] + 2.0 * (k2_[i] + k3_[i]) + k4_[i]);
    }
    time_s_ = target_s;
  }

  /// Components from `first` to `last` at a share x of the way through the last step.
  virtual void interpolate_step(double x, std::size_t first, std::size_t last, S* out) const {
    const HermiteCubic cubic(x, time_s_ - before_s_);
    for (std::size_t i = first; i < last; ++i) {
      out[i - first] = cubic.interpolate(y_before_[i], y_[i], rate_before_[i], rate_[i]);
    }
  }

  void evaluate(double time_s, const Vector& y, Vector& rate) {
    system_.evaluate(time_s, y.data(), rate.data(), rate.data() + n_);
  }
  void add_scaled(double h_s, const Vector& rate) {
    for (std::size_t i = 0; i < n_; ++i) stage_[i] = y_before_[i] + h_s * rate[i];
  }
  /// Whether the segment may end early.
  bool is_watched() const { return stop_ != nullptr; }

  OdeSystem<S>& system_;
  std::size_t n_;
  std::size_t m_;
  std::size_t total_;
  Vector y_, y_before_, rate_, rate_before_, k2_, k3_, k4_, stage_;
  double time_s_ = 0.0;
  double before_s_ = 0.0;

 private:
  bool stop_inside_step() {
    Vector inside(n_);
    const auto distance = [&](double time_s) {
      interpolate_state(time_s, inside.data());
      return stop_->find_distance(value_of(system_.watch(stop_->watch, time_s, inside.data())));
    };
    if (distance(time_s_) > 0.0) return false;
    double event_s = before_s_;
    if (distance(before_s_) > 0.0) {
      constexpr int kBits = 50;
      std::uintmax_t iterations = 100;
      const auto bracket = boost::math::tools::toms748_solve(
          distance, before_s_, time_s_, boost::math::tools::eps_tolerance<double>(kBits), iterations);
      event_s = bracket.second;
    }
    advance_to(event_s);
    return true;
  }

  void interpolate(double time_s, std::size_t first, std::size_t last, S* out) const {
    const double h_s = time_s_ - before_s_;
    if (h_s > 0.0 && time_s != time_s_) return interpolate_step((time_s - before_s_) / h_s, first, last, out);
    std::copy(y_.begin() + static_cast<std::ptrdiff_t>(first), y_.begin() + static_cast<std::ptrdiff_t>(last), out);
  }

  double max_step_s_ = 0.0;
  const StopCondition* stop_ = nullptr;
};

}  // namespace rollrig::sim
