#pragma once
/// What keeps Simbody's exceptions, whose type only this library knows, from those who run a multibody rig.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rigs/multibody/simbody_system.h"

namespace rollrig::rigs {

/// A rig as `Interface` shows it, which hands everything on to the `System` inside.
/// Errors  RunFailure: what Simbody refuses
template <class Interface, class System>
class GuardedRig : public Interface {
 public:
  template <class... Arguments>
  explicit GuardedRig(Arguments&&... arguments)
      : system_(guarded([&] { return std::make_unique<System>(std::forward<Arguments>(arguments)...); })) {}

  std::size_t state_count() const override { return system_->state_count(); }
  std::vector<double> state_tolerances() const override { return system_->state_tolerances(); }
  const std::vector<sim::Integral>& integrals() const override { return system_->integrals(); }
  const std::vector<sim::Store>& stores() const override { return system_->stores(); }
  const std::vector<sim::Channel>& channels() const override { return system_->channels(); }
  std::vector<sim::PoseCoordinate> poses() const override { return system_->poses(); }

  void initialize(const sim::Segment& first, double time_s, double* state) override {
    guarded([&] { system_->initialize(first, time_s, state); });
  }
  void begin_phase(const sim::Phase& phase, double time_s, double* state) override {
    guarded([&] { system_->begin_phase(phase, time_s, state); });
  }
  void begin_segment(const sim::Segment& segment, double time_s, double* state, double* integrals) override {
    guarded([&] { system_->begin_segment(segment, time_s, state, integrals); });
  }
  void evaluate(double time_s, const double* state, double* rates, double* integrands) override {
    guarded([&] { system_->evaluate(time_s, state, rates, integrands); });
  }
  void require_possible(const double* state) const override { system_->require_possible(state); }
  double watch(const std::string& name, double time_s, const double* state) override {
    return guarded([&] { return system_->watch(name, time_s, state); });
  }
  void observe(double time_s, const double* state, double* values) override {
    guarded([&] { system_->observe(time_s, state, values); });
  }
  void calc_stored(double time_s, const double* state, double* stored_J) override {
    guarded([&] { system_->calc_stored(time_s, state, stored_J); });
  }

 protected:
  System& system() { return *system_; }
  const System& system() const { return *system_; }

 private:
  std::unique_ptr<System> system_;
};

}  // namespace rollrig::rigs
