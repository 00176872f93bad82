#pragma once
/// The explicit midpoint rule with one evaluation a step: its predictor takes the rates of the step before.

#include "sim/fixed_grid_integrator.h"

namespace rollrig::sim {

/// Equation  y_{n+1} = y_n + h f(t_n + h/2, y_n + h/2 f_{n-1}),  f_{n-1} the rates found in the middle of the step
///           before, across knots as well; in the first step those at y_0. States and integrals run straight through
///           a step
/// Validity  steps well below every time constant, most of all where rates jump at a knot: the step after it begins
///           with those from before
/// Accuracy  order 2 in states and integrals at the ends of steps
/// Checked   tests/sim/lagged_midpoint_integrator_test.cpp
template <class S>
class LaggedMidpointIntegrator : public FixedGridIntegrator<S> {
 public:
  using FixedGridIntegrator<S>::FixedGridIntegrator;

 private:
  using Base = FixedGridIntegrator<S>;
  using Base::before_s_, Base::rate_, Base::rate_before_, Base::stage_, Base::y_, Base::y_before_;

  void begin() override {}

  void advance_to(double target_s) override {
    const double h_s = target_s - before_s_;
    const double middle_s = before_s_ + 0.5 * h_s;
    if (!has_rates_) this->evaluate(middle_s, y_before_, rate_before_);
    has_rates_ = true;
    this->add_scaled(0.5 * h_s, rate_before_);
    this->evaluate(middle_s, stage_, rate_);
    for (std::size_t i = 0; i < this->total_; ++i) y_[i] = y_before_[i] + h_s * rate_[i];
    this->time_s_ = target_s;
  }

  void interpolate_step(double share, std::size_t first, std::size_t last, S* out) const override {
    constexpr double kRounding = 1e-9;  // of sums of durations: a time that near to an end of the step is that end
    if (share < kRounding) share = 0.0;
    for (std::size_t i = first; i < last; ++i) out[i - first] = y_before_[i] + share * (y_[i] - y_before_[i]);
  }

  bool has_rates_ = false;
};

}  // namespace rollrig::sim
