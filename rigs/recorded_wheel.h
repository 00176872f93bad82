#pragma once
/// A measured wheel simulated again: it moves as recorded, its tire does what the equations make of it.

#include <vector>

#include "models/quantities.h"
#include "rigs/quasi_static_rig.h"

namespace rollrig::rigs {

/// Integrals, in this order: means of channels that sensors can show, means of others, energies of all wheels.
enum class RecordedIntegral : std::size_t {
  kForce,
  kTireReadings,  // one each of models::kTireChannels
  kRimTemperature = kTireReadings + models::kTireChannels.size(),
  kContactLoad,
  kSurfaceSpeed,
  kRollingResistance,
  kParasitic,
  kFrictionBrake,
  kHubWork,
  kRollerWork,
  kGravityWork,
  kKnotWork,
  kThroughput,
  kTireLoss,
  kSlipLoss,
  kBearingLoss,
  kDragLoss,
  kHeatGenerated,
  kHeatToAir,
  kHeatToRoad
};
constexpr std::size_t index_of(RecordedIntegral integral) { return static_cast<std::size_t>(integral); }

/// A channel that is a mean.
inline sim::Channel make_mean_channel(const Quantity& quantity, RecordedIntegral integral) {
  return {quantity, index_of(integral)};
}
inline sim::Channel make_tire_channel(const Quantity& quantity) {
  return {quantity, index_of(RecordedIntegral::kTireReadings) + models::index_of_tire_channel(quantity)};
}

/// Power of all wheels at an instant, and what moves with the surface.
template <class S>
struct RecordedPowers {
  S moving_kg{};
  S hub_W{};  // of the hubs on their wheels
  S roller_W{};
  S gravity_W{};
  S tire_W{};
  S slip_W{};
  S bearing_W{};
  S drag_W{};
};

/// State vector: the states of a corner for each kind of tires. A corner stands for all tires of its kind.
///
/// Validity  the middle of a segment stands for all of it: speed runs straight through its value there, a load holds. A
///           segment is one step of an integrator, well below every time constant
/// Energy    kinetic energy of that motion; where it jumps between two segments, with load, speed or mass, the jump is
///           the term "load_changes" of the mechanical audit
/// Checked   tests/rigs/recorded_wheel_test.cpp, tests/scenarios/recorded_inputs_test.cpp
template <class S>
class RecordedWheel : public QuasiStaticRig<S> {
 public:
  void initialize(const sim::Segment& first, double time_s, S* state) override;
  void begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) override;
  void evaluate(double time_s, const S* state, S* rates, S* integrands) override;
  /// All channels are means.
  void observe(double, const S*, S*) override {}
  void calc_stored(double time_s, const S* state, S* stored_J) override;

 protected:
  using typename QuasiStaticRig<S>::Wheel;
  using QuasiStaticRig<S>::present_;

  /// `channels` are those of the detail. A channel of a tire is the mean over all tires.
  RecordedWheel(const std::vector<models::Corner<S>*>& corners, RigStart<S> start, bool surface_recorded,
                const std::vector<sim::Channel>& channels, Detail detail);

  /// Puts what is recorded at a time into `inputs` of a wheel.
  virtual void read_inputs(double time_s, std::size_t wheel, models::InputPort<S>& inputs) const = 0;
  /// From the losses of the wheels: their slip, and force_N_, which is measured.
  virtual void find_force() = 0;
  /// In the motion found last.
  virtual RecordedPowers<S> find_powers() const = 0;

  Wheel& wheel() { return this->wheels_.front(); }
  const Wheel& wheel() const { return this->wheels_.front(); }
  /// Slip from the force of the surface on the wheel.
  static void put_contact_force(Wheel& wheel, const S& contact_N);

  std::vector<double> group_sizes_{1.0};  // tires for which each wheel stands
  double tires_ = 1.0;                    // their sum
  S force_N_{};

 private:
  void find_motion(double time_s, const S* state);
  void set_segment_motion(const S* state);
  S calc_kinetic_J(double time_s) const;
  S find_recorded_speed_m_s(double time_s, const S* state) override;
  void put_tire_means(S* means, std::size_t count) const;
  void put_further(S* integrands) const;

  Detail detail_;

  // Motion through the present segment.
  S moving_kg_{};
  S middle_m_s_{};
  S acceleration_m_s2_{};
};

}  // namespace rollrig::rigs
