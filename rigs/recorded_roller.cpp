#include "rigs/recorded_roller.h"

#include <algorithm>
#include <utility>

namespace rollrig::rigs {
namespace {

namespace quantities = models::quantities;

std::vector<sim::Channel> make_roller_channels(bool has_rim, Detail detail) {
  std::vector<sim::Channel> channels{make_mean_channel(quantities::kLossForce, RecordedIntegral::kForce)};
  for (const models::TireChannel& tire : models::kTireChannels) channels.push_back(make_tire_channel(tire.quantity));
  if (has_rim) channels.push_back(make_mean_channel(quantities::kRimTemperature, RecordedIntegral::kRimTemperature));
  channels.push_back(make_mean_channel(quantities::kContactLoad, RecordedIntegral::kContactLoad));
  channels.push_back(make_mean_channel(quantities::kSpeedReading, RecordedIntegral::kSurfaceSpeed));
  if (detail == Detail::kMeasured) return channels;
  channels.push_back(make_mean_channel(quantities::kRollingResistance, RecordedIntegral::kRollingResistance));
  channels.push_back(make_mean_channel(quantities::kParasiticLoss, RecordedIntegral::kParasitic));
  return channels;
}

}  // namespace

template <class S>
RecordedRoller<S>::RecordedRoller(models::Corner<S>& corner, RigStart<S> start, bool surface_recorded, Detail detail)
    : RecordedWheel<S>({&corner}, std::move(start), surface_recorded,
                       make_roller_channels(corner.nodes()[models::index_of(models::Node::kRim)], detail), detail) {}

template <class S>
void RecordedRoller<S>::read_inputs(double time_s, std::size_t, models::InputPort<S>& inputs) const {
  read_drum_inputs(this->present_, time_s, inputs);
  const double force_N = this->present_.segment.inputs[kLongitudinalForceInput].at(this->present_.elapsed_s(time_s));
  inputs.longitudinal_force_N = S(force_N);
  inputs.brake_force_N = S(std::max(0.0, -force_N));
}

template <class S>
void RecordedRoller<S>::find_force() {
  put_force(S(-this->wheel().now.acting.longitudinal_force_N));
}

template <class S>
void RecordedRoller<S>::put_force(const S& contact_N) {
  const models::Instant<S>& now = this->wheel().now;
  this->put_contact_force(this->wheel(), contact_N);
  const S slip_N = now.motion.longitudinal_force_N * this->wheel().slip;
  this->force_N_ = models::calc_loss_force_N(now, slip_N, now.motion.acceleration_m_s2);
}

template <class S>
RecordedPowers<S> RecordedRoller<S>::find_powers() const {
  const models::Instant<S>& now = this->wheel().now;
  const models::RollingWheel<S>& rolling = this->wheel().rolling;
  const models::Motion<S>& motion = now.motion;
  const S machine_kg = now.contact.machine_inertia_factor * now.context->machine_mass_kg;
  const S hub_N = rolling.calc_balance_N(zero<S>(), motion.acceleration_m_s2, zero<S>()) - motion.longitudinal_force_N;
  const S roller_N = now.rolling_resistance_N - rolling.loss_at_wheel_N + now.parasitic_N +
                     machine_kg * motion.acceleration_m_s2 + motion.longitudinal_force_N;
  RecordedPowers<S> power;
  power.moving_kg = machine_kg + rolling.spin_mass_kg;
  power.hub_W = hub_N * motion.speed_m_s + motion.slip_power_W;
  power.roller_W = roller_N * motion.speed_m_s;
  power.tire_W = now.rolling_resistance_N * motion.speed_m_s;
  power.slip_W = motion.slip_power_W;
  power.bearing_W = now.parasitic_N * motion.speed_m_s;
  return power;
}

template class RecordedRoller<double>;
template class RecordedRoller<Jet>;

}  // namespace rollrig::rigs
