#include "rigs/recorded_wheel.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/energy_audit.h"

namespace rollrig::rigs {
namespace {

std::vector<sim::Integral> make_integrals(const std::vector<sim::Channel>& channels, Detail detail) {
  using Role = sim::Integral::Role;
  std::vector<sim::Integral> integrals{{"force"}};
  add_tire_integrals(integrals);
  const std::vector<sim::Integral> further{{"rim_temperature"},
                                           {"contact_load"},
                                           {"surface_speed"},
                                           {"rolling_resistance"},
                                           {"parasitic"},
                                           {"friction_brake"},
                                           {sim::kMotorWork, Role::kWorkIn},
                                           {"rollers", Role::kWorkIn},
                                           {"gravity", Role::kWorkIn},
                                           {"load_changes", Role::kWorkIn},
                                           {"throughput", Role::kThroughput},
                                           {"tire_loss", Role::kDissipated},
                                           {"slip_loss", Role::kDissipated},
                                           {"bearing_loss", Role::kDissipated},
                                           {"drag_loss", Role::kDissipated},
                                           {"heat_generated", Role::kHeatIn},
                                           {"heat_to_air", Role::kHeatOut},
                                           {"heat_to_road", Role::kHeatOut}};
  integrals.insert(integrals.end(), further.begin(), further.end());
  if (detail == Detail::kFull) return integrals;
  std::size_t last = 0;
  for (const sim::Channel& channel : channels) last = std::max(last, channel.integral);
  integrals.resize(last + 1);
  return integrals;
}

std::vector<sim::Store> make_stores(Detail detail) {
  using Role = sim::Store::Role;
  if (detail == Detail::kMeasured) return {};
  return {{"kinetic", Role::kMechanical}, {"stored_heat", Role::kHeat}};
}

}  // namespace

template <class S>
RecordedWheel<S>::RecordedWheel(const std::vector<models::Corner<S>*>& corners, RigStart<S> start,
                                bool surface_recorded, const std::vector<sim::Channel>& channels, Detail detail)
    : QuasiStaticRig<S>({make_integrals(channels, detail), make_stores(detail), channels}, corners, 0, std::move(start),
                        surface_recorded),
      detail_(detail) {}

template <class S>
void RecordedWheel<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  present_.take(first, time_s);
  for (std::size_t i = 0; i < this->wheels_.size(); ++i) {
    models::InputPort<S> inputs;
    read_inputs(time_s, i, inputs);
    this->begin_wheel(this->wheels_[i], inputs.load_N, state);
  }
  if (detail_ == Detail::kFull) set_segment_motion(state);
}

template <class S>
void RecordedWheel<S>::begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) {
  if (detail_ == Detail::kMeasured) return present_.take(segment, time_s);
  const S former_J = calc_kinetic_J(time_s);
  present_.take(segment, time_s);
  set_segment_motion(state);
  integrals[index_of(RecordedIntegral::kKnotWork)] += calc_kinetic_J(time_s) - former_J;
}

/// The motion in the middle of the present segment, which stands for all of it.
template <class S>
void RecordedWheel<S>::set_segment_motion(const S* state) {
  find_motion(present_.segment_start_s + 0.5 * present_.segment.duration_s, state);
  moving_kg_ = find_powers().moving_kg;
  middle_m_s_ = wheel().now.motion.speed_m_s;
  acceleration_m_s2_ = wheel().now.motion.acceleration_m_s2;
}

template <class S>
S RecordedWheel<S>::calc_kinetic_J(double time_s) const {
  const double from_middle_s = present_.elapsed_s(time_s) - 0.5 * present_.segment.duration_s;
  return models::calc_kinetic_J(moving_kg_, S(middle_m_s_ + from_middle_s * acceleration_m_s2_));
}

template <class S>
void RecordedWheel<S>::find_motion(double time_s, const S* state) {
  for (std::size_t i = 0; i < this->wheels_.size(); ++i) {
    Wheel& wheel = this->wheels_[i];
    read_inputs(time_s, i, wheel.now.recorded);
    this->apply_inputs(wheel, state);
    this->find_losses(wheel, wheel.now.acting.speed_m_s, state);
  }
  find_force();
}

template <class S>
void RecordedWheel<S>::put_contact_force(Wheel& wheel, const S& contact_N) {
  wheel.now.motion.longitudinal_force_N = contact_N;
  wheel.slip = models::calc_slip(wheel.now);
  models::put_slip(wheel.rolling, wheel.slip, wheel.now.motion);
}

template <class S>
void RecordedWheel<S>::evaluate(double time_s, const S* state, S* rates, S* integrands) {
  find_motion(time_s, state);
  for (Wheel& wheel : this->wheels_) this->calc_rates(wheel, state, rates);
  constexpr std::size_t kFirst = index_of(RecordedIntegral::kTireReadings);
  const std::size_t count = std::min(this->integrals().size(), index_of(RecordedIntegral::kContactLoad));
  integrands[index_of(RecordedIntegral::kForce)] = force_N_;
  if (count > kFirst) put_tire_means(&integrands[kFirst], count - kFirst);
  if (this->integrals().size() > index_of(RecordedIntegral::kSurfaceSpeed)) {
    integrands[index_of(RecordedIntegral::kContactLoad)] = wheel().now.acting.load_N;
    integrands[index_of(RecordedIntegral::kSurfaceSpeed)] = wheel().now.acting.speed_m_s;
  }
  if (detail_ == Detail::kFull) put_further(integrands);
}

/// Readings of the tires, then temperature of the rim: the first `count` of them.
template <class S>
void RecordedWheel<S>::put_tire_means(S* means, std::size_t count) const {
  std::array<S, models::kTireChannels.size() + 1> readings;
  for (std::size_t i = 0; i < this->wheels_.size(); ++i) {
    const models::Instant<S>& now = this->wheels_[i].now;
    put_tire_readings(now, readings.data());
    readings.back() = now.thermal.temperature_K[models::index_of(models::Node::kRim)];
    for (std::size_t k = 0; k < count; ++k) {
      const S part = this->wheels_.size() == 1 ? readings[k] : S(group_sizes_[i] / tires_ * readings[k]);
      means[k] = i == 0 ? part : S(means[k] + part);
    }
  }
}

template <class S>
void RecordedWheel<S>::put_further(S* integrands) const {
  using std::abs;
  const auto put = [integrands](RecordedIntegral integral, const S& value) { integrands[index_of(integral)] = value; };
  const RecordedPowers<S> power = find_powers();
  const auto first = index_of(RecordedIntegral::kRollingResistance);
  std::fill(integrands + first, integrands + this->integrals().size(), zero<S>());
  for (std::size_t i = 0; i < this->wheels_.size(); ++i) {
    const models::Instant<S>& now = this->wheels_[i].now;
    const double share = group_sizes_[i] / tires_;
    integrands[first] += share * now.rolling_resistance_N;
    integrands[index_of(RecordedIntegral::kParasitic)] += share * now.parasitic_N;
    integrands[index_of(RecordedIntegral::kFrictionBrake)] += group_sizes_[i] * now.acting.brake_force_N;
    std::array<S, 3> heat;
    put_heat(now.heat, heat.data());
    for (std::size_t k = 0; k < heat.size(); ++k) {
      integrands[index_of(RecordedIntegral::kHeatGenerated) + k] += group_sizes_[i] * heat[k];
    }
  }
  put(RecordedIntegral::kHubWork, power.hub_W);
  put(RecordedIntegral::kRollerWork, power.roller_W);
  put(RecordedIntegral::kGravityWork, power.gravity_W);
  put(RecordedIntegral::kThroughput, S(abs(power.hub_W)) + S(abs(power.roller_W)));
  put(RecordedIntegral::kTireLoss, power.tire_W);
  put(RecordedIntegral::kSlipLoss, power.slip_W);
  put(RecordedIntegral::kBearingLoss, power.bearing_W);
  put(RecordedIntegral::kDragLoss, power.drag_W);
}

template <class S>
void RecordedWheel<S>::calc_stored(double time_s, const S* state, S* stored_J) {
  if (detail_ == Detail::kMeasured) return;
  stored_J[0] = calc_kinetic_J(time_s);
  stored_J[1] = zero<S>();
  for (std::size_t i = 0; i < group_sizes_.size(); ++i) {
    const Wheel& wheel = this->wheels_[i];
    stored_J[1] += group_sizes_[i] * wheel.corner->calc_stored_heat_J(state + wheel.first_state);
  }
}

template <class S>
S RecordedWheel<S>::find_recorded_speed_m_s(double time_s, const S*) {
  read_inputs(time_s, 0, wheel().now.recorded);
  return wheel().now.recorded.speed_m_s;
}

template class RecordedWheel<double>;
template class RecordedWheel<Jet>;

}  // namespace rollrig::rigs
