#include "rigs/recorded_wheel.h"

#include <algorithm>
#include <utility>

#include "sim/energy_audit.h"

namespace rollrig::rigs {
namespace {

std::vector<sim::Integral> make_integrals(const std::vector<sim::Channel>& channels, Detail detail) {
  using Role = sim::Integral::Role;
  std::vector<sim::Integral> integrals{{"force"}};
  add_tire_integrals(integrals);
  const std::vector<sim::Integral> further{{"rim_temperature"},
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
RecordedWheel<S>::RecordedWheel(models::Corner<S>& corner, RigStart<S> start, bool surface_recorded,
                                const std::vector<sim::Channel>& channels, Detail detail)
    : QuasiStaticRig<S>({make_integrals(channels, detail), make_stores(detail), channels}, {&corner}, 0,
                        std::move(start), surface_recorded),
      detail_(detail) {}

template <class S>
void RecordedWheel<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  present_.take(first, time_s);
  models::InputPort<S> inputs;
  read_inputs(time_s, inputs);
  this->begin_wheel(wheel(), inputs.load_N, state);
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
  read_inputs(time_s, wheel().now.recorded);
  this->apply_inputs(wheel(), state);
  this->find_losses(wheel(), wheel().now.acting.speed_m_s, state);
  find_force();
}

template <class S>
void RecordedWheel<S>::put_contact_force(const S& contact_N) {
  models::Instant<S>& now = wheel().now;
  now.motion.longitudinal_force_N = contact_N;
  wheel().slip = models::calc_slip(now);
  models::put_slip(wheel().rolling, wheel().slip, now.motion);
}

template <class S>
void RecordedWheel<S>::evaluate(double time_s, const S* state, S* rates, S* integrands) {
  find_motion(time_s, state);
  this->calc_rates(wheel(), state, rates);
  const std::size_t count = this->integrals().size();
  const models::Instant<S>& now = wheel().now;
  const auto is_integrated = [count](RecordedIntegral integral) { return index_of(integral) < count; };
  integrands[index_of(RecordedIntegral::kForce)] = force_N_;
  if (is_integrated(RecordedIntegral::kTireReadings)) {
    put_tire_readings(now, &integrands[index_of(RecordedIntegral::kTireReadings)]);
  }
  if (is_integrated(RecordedIntegral::kRimTemperature)) {
    integrands[index_of(RecordedIntegral::kRimTemperature)] =
        now.thermal.temperature_K[models::index_of(models::Node::kRim)];
  }
  if (detail_ == Detail::kFull) put_further(integrands);
}

template <class S>
void RecordedWheel<S>::put_further(S* integrands) const {
  using std::abs;
  const auto put = [integrands](RecordedIntegral integral, const S& value) { integrands[index_of(integral)] = value; };
  const models::Instant<S>& now = wheel().now;
  const RecordedPowers<S> power = find_powers();
  put(RecordedIntegral::kRollingResistance, now.rolling_resistance_N);
  put(RecordedIntegral::kParasitic, now.parasitic_N);
  put(RecordedIntegral::kFrictionBrake, wheels_alike_ * now.acting.brake_force_N);
  put(RecordedIntegral::kHubWork, power.hub_W);
  put(RecordedIntegral::kRollerWork, power.roller_W);
  put(RecordedIntegral::kGravityWork, power.gravity_W);
  put(RecordedIntegral::kKnotWork, zero<S>());
  put(RecordedIntegral::kThroughput, S(abs(power.hub_W)) + S(abs(power.roller_W)));
  put(RecordedIntegral::kTireLoss, power.tire_W);
  put(RecordedIntegral::kSlipLoss, power.slip_W);
  put(RecordedIntegral::kBearingLoss, power.bearing_W);
  put(RecordedIntegral::kDragLoss, power.drag_W);
  const std::size_t heat = index_of(RecordedIntegral::kHeatGenerated);
  put_heat(now.heat, &integrands[heat]);
  for (std::size_t i = heat; i < this->integrals().size(); ++i) integrands[i] *= wheels_alike_;
}

template <class S>
void RecordedWheel<S>::calc_stored(double time_s, const S* state, S* stored_J) {
  if (detail_ == Detail::kMeasured) return;
  stored_J[0] = calc_kinetic_J(time_s);
  stored_J[1] = wheels_alike_ * this->calc_stored_heat_J(state);
}

template <class S>
S RecordedWheel<S>::find_recorded_speed_m_s(double time_s, const S*) {
  read_inputs(time_s, wheel().now.recorded);
  return wheel().now.recorded.speed_m_s;
}

template class RecordedWheel<double>;
template class RecordedWheel<Jet>;

}  // namespace rollrig::rigs
