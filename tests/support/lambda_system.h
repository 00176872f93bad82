#pragma once
/// A system made of functions, for tests of integrators.

#include <functional>
#include <stdexcept>

#include "sim/ode_system.h"

namespace rollrig::tests {

/// dy/dt = rates(t, y) with the integral of each state as an integral, and each state as an instant
/// channel "y<i>" and a mean channel "mean_y<i>". The input of a segment, where there is one, is added to
/// the first rate.
class LambdaSystem : public sim::OdeSystem<double> {
 public:
  using Rates = std::function<void(double t, const double* y, double* rates)>;

  LambdaSystem(std::vector<double> start, Rates rates, double tolerance = 1e-9)
      : start_(std::move(start)), rates_(std::move(rates)), tolerance_(tolerance) {
    for (std::size_t i = 0; i < start_.size(); ++i) {
      integrals_.push_back({"integral_y" + std::to_string(i), sim::Integral::Role::kChannel, tolerance});
      channels_.push_back({intern_quantity("y" + std::to_string(i))});
    }
    for (std::size_t i = 0; i < start_.size(); ++i)
      channels_.push_back({intern_quantity("mean_y" + std::to_string(i)), i});
  }

  std::size_t state_count() const override { return start_.size(); }
  std::vector<double> state_tolerances() const override { return std::vector<double>(start_.size(), tolerance_); }
  const std::vector<sim::Integral>& integrals() const override { return integrals_; }
  const std::vector<sim::Store>& stores() const override { return stores_; }
  const std::vector<sim::Channel>& channels() const override { return channels_; }

  void initialize(const sim::Segment&, double, double* state) override {
    std::copy(start_.begin(), start_.end(), state);
  }
  void begin_phase(const sim::Phase& phase, double, double* state) override {
    for (const sim::Command& command : phase.commands) state[0] += command.value_SI;
  }
  void begin_segment(const sim::Segment& segment, double time_s, double*, double*) override {
    segment_ = &segment;
    segment_start_s_ = time_s;
  }
  void evaluate(double t, const double* y, double* rates, double* integrands) override {
    if (rates != nullptr) {
      rates_(t, y, rates);
      if (!segment_->inputs.empty()) rates[0] += segment_->inputs[0].at(t - segment_start_s_);
    }
    if (integrands != nullptr) std::copy(y, y + start_.size(), integrands);
  }
  void require_possible(const double*) const override {}
  double watch(const std::string& name, double, const double* y) override {
    if (name != "y0") throw std::invalid_argument("cannot watch " + name);
    return y[0];
  }
  void observe(double, const double* y, double* values) override { std::copy(y, y + start_.size(), values); }
  void calc_stored(double, const double*, double*) override {}

 private:
  std::vector<double> start_;
  Rates rates_;
  double tolerance_;
  std::vector<sim::Integral> integrals_;
  std::vector<sim::Store> stores_;
  std::vector<sim::Channel> channels_;
  const sim::Segment* segment_ = nullptr;
  double segment_start_s_ = 0.0;
};

inline sim::Phase plain_phase(double duration_s, double max_step_s = 5.0) {
  sim::Phase phase;
  phase.name = "phase";
  phase.segments = {{duration_s, {}}};
  phase.max_step_s = max_step_s;
  return phase;
}

}  // namespace rollrig::tests
