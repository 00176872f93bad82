#pragma once
/// What the rigs share whose mechanics are in equilibrium: wheels, each with the states of its corner.

#include <algorithm>
#include <utility>
#include <vector>

#include "models/corner.h"
#include "models/wheel/rolling_wheel.h"
#include "rigs/rig_system.h"

namespace rollrig::rigs {

/// State vector: what the rig has of its own (its speed, or nothing), then the states of each wheel's corner.
template <class S>
class QuasiStaticRig : public RigSystem<S> {
 public:
  std::size_t state_count() const override { return wheels_.back().first_state + wheels_.back().corner->state_count(); }

  std::vector<double> state_tolerances() const override {
    std::vector<double> tolerances(wheels_.front().first_state, 1.0);
    for (const Wheel& wheel : wheels_) {
      for (const models::CornerState& state : wheel.corner->states()) tolerances.push_back(state.scale_SI);
    }
    return tolerances;
  }

  void require_possible(const S* state) const override {
    for (const Wheel& wheel : wheels_) wheel.corner->require_possible(state + wheel.first_state);
  }

  const models::Inflation<S>& inflation(std::size_t wheel = 0) const { return wheels_[wheel].now.inflation; }

 protected:
  /// What one wheel does at an instant. Forces as at the surface.
  struct Wheel {
    models::Corner<S>* corner = nullptr;
    std::size_t first_state = 0;
    models::Instant<S> now;
    models::RollingWheel<S> rolling;
    S slip{};  // of the wheel against the surface, positive when it is dragged
  };

  /// `corners` outlive the rig, which has `own_states` states before theirs.
  QuasiStaticRig(typename RigSystem<S>::Lists lists, const std::vector<models::Corner<S>*>& corners,
                 std::size_t own_states, RigStart<S> start, bool surface_recorded)
      : RigSystem<S>(std::move(lists), surface_recorded), start_(std::move(start)) {
    std::size_t first_state = own_states;
    for (models::Corner<S>* corner : corners) {
      wheels_.push_back({corner, first_state, {}, {}, {}});
      first_state += corner->state_count();
    }
  }

  void set_pressure(double pressure_Pa, S* state) override {
    for (Wheel& wheel : wheels_) {
      wheel.corner->inflate(S(pressure_Pa), state + wheel.first_state, wheel.now.inflation);
    }
  }
  std::size_t tire_temperature_state() const override {
    return wheels_.front().first_state + wheels_.front().corner->state_of(models::Node::kLiner);
  }

  /// Puts a wheel at the start of a run, on which `load_N` rests.
  void begin_wheel(Wheel& wheel, const S& load_N, S* state) {
    wheel.now = {};
    wheel.now.recorded.air_density_ratio = S(1.0);
    wheel.now.inflation = start_.inflation();
    wheel.corner->initialize(start_.tire_temperature_K, start_.history_under(load_N), state + wheel.first_state);
  }

  /// Ports from the recorded inputs on.
  void apply_inputs(Wheel& wheel, const S* state) { wheel.corner->apply_inputs(state + wheel.first_state, wheel.now); }
  /// The wheel at a speed, under the load that acts, up to its losses. Forces and slip come after them (docs/ports.md).
  void find_losses(Wheel& wheel, const S& speed_m_s, const S* state) {
    wheel.now.motion = {};
    wheel.now.motion.acceleration_m_s2 = wheel.now.acting.acceleration_m_s2;
    wheel.now.motion.speed_m_s = speed_m_s;
    wheel.now.motion.load_N = wheel.now.acting.load_N;
    wheel.corner->calc_losses(state + wheel.first_state, wheel.now);
    wheel.rolling = models::find_rolling_wheel(wheel.now);
  }
  void calc_rates(Wheel& wheel, const S* state, S* rates) {
    wheel.corner->calc_rates(state + wheel.first_state, wheel.now, rates + wheel.first_state);
  }

  /// States of further nodes and of effects, after rubber and gas; returns the place after them.
  S* put_further_states(const Wheel& wheel, const S* state, S* values) const {
    const S* states = state + wheel.first_state;
    return std::copy(states + 2, states + wheel.corner->state_count(), values);
  }

  S calc_stored_heat_J(const S* state) const {
    S sum_J = zero<S>();
    for (const Wheel& wheel : wheels_) sum_J += wheel.corner->calc_stored_heat_J(state + wheel.first_state);
    return sum_J;
  }

  RigStart<S> start_;
  std::vector<Wheel> wheels_;
};

}  // namespace rollrig::rigs
