#include "rigs/driven_wheel.h"

namespace rollrig::rigs {

template <class S>
void DrivenWheel<S>::read_inputs(double time_s, std::size_t wheel, models::InputPort<S>& inputs) const {
  RecordedRoller<S>::read_inputs(time_s, wheel, inputs);
  inputs.acceleration_m_s2 = given_.acceleration_m_s2;
  inputs.speed_m_s += given_.seeds[index_of(DrumInput::kSpeed)];
  inputs.load_N += given_.seeds[index_of(DrumInput::kLoad)];
  inputs.ambient_K += given_.seeds[index_of(DrumInput::kAmbient)];
  inputs.surface_K += given_.seeds[index_of(DrumInput::kSurface)];
  inputs.longitudinal_force_N += given_.seeds[kLongitudinalForceInput];
}

template <class S>
void DrivenWheel<S>::find_force() {
  const models::Instant<S>& now = this->wheel().now;
  const S balance_N = this->wheel().rolling.calc_balance_N(zero<S>(), now.motion.acceleration_m_s2, zero<S>());
  this->put_force(S(balance_N - now.acting.longitudinal_force_N));
}

template class DrivenWheel<double>;
template class DrivenWheel<Jet>;

}  // namespace rollrig::rigs
