#include "rigs/quasi_static_drum.h"

namespace rollrig::rigs {

template <class S>
QuasiStaticDrum<S>::QuasiStaticDrum(models::Corner<S>& corner, RigStart<S> start, bool surface_recorded, Detail detail)
    : Base({make_drum_integrals(detail), make_drum_stores(detail),
            make_drum_channels(corner.context().machine, corner.states(), surface_recorded, detail)},
           {&corner}, 1, std::move(start), surface_recorded),
      detail_(detail) {}

template <class S>
void QuasiStaticDrum<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  present_.take(first, time_s);
  present_.drive_on = true;
  this->begin_wheel(wheels_.front(), S(first.inputs[index_of(DrumInput::kLoad)].start), state);
  find_motion(time_s, state);
  state[kSpeedState] = now().acting.speed_m_s;
}

template <class S>
void QuasiStaticDrum<S>::begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) {
  if (detail_ == Detail::kMeasured) {
    present_.take(segment, time_s);
    if (present_.drive_on) state[kSpeedState] = apply_inputs_at(time_s, state).acting.speed_m_s;
    return;
  }
  find_motion(time_s, state);
  const S before_J = calc_kinetic_J() + calc_spring_J();
  present_.take(segment, time_s);
  find_motion(time_s, state);
  if (present_.drive_on) state[kSpeedState] = now().acting.speed_m_s;
  integrals[index_of(DrumIntegral::kKnotWork)] += calc_kinetic_J() + calc_spring_J() - before_J;
}

template <class S>
models::Instant<S>& QuasiStaticDrum<S>::apply_inputs_at(double time_s, const S* state) {
  typename Base::Wheel& wheel = wheels_.front();
  read_drum_inputs(present_, time_s, wheel.now.recorded);
  this->apply_inputs(wheel, state);
  return wheel.now;
}

/// Fills the wheel up to the losses, its motion and the torque.
template <class S>
void QuasiStaticDrum<S>::find_motion(double time_s, const S* state) {
  models::Instant<S>& now = apply_inputs_at(time_s, state);
  typename Base::Wheel& wheel = wheels_.front();
  models::Motion<S>& motion = now.motion;
  this->find_losses(wheel, present_.drive_on ? now.acting.speed_m_s : state[kSpeedState], state);
  const S resistance_N = now.rolling_resistance_N + now.parasitic_N;
  const S effective_mass_kg = calc_effective_mass_kg();
  if (!present_.drive_on) motion.acceleration_m_s2 = -resistance_N / effective_mass_kg;
  // Slip of the wheel's own making: rolling resistance and the wheel's inertia drag on the contact.
  const S spin_force_N = wheel.rolling.spin_mass_kg * motion.acceleration_m_s2;
  motion.longitudinal_force_N = wheel.rolling.loss_at_wheel_N + spin_force_N;
  wheel.slip = models::calc_slip(now);
  models::put_slip(wheel.rolling, wheel.slip, motion);
  motor_torque_Nm_ = zero<S>();
  if (present_.drive_on) {
    motor_torque_Nm_ = (resistance_N + effective_mass_kg * motion.acceleration_m_s2 + wheel.slip * spin_force_N) *
                       context().machine_radius_m;
  }
}

template <class S>
S QuasiStaticDrum<S>::calc_effective_mass_kg() const {
  return now().contact.machine_inertia_factor * context().machine_mass_kg + wheels_.front().rolling.spin_mass_kg;
}

template <class S>
S QuasiStaticDrum<S>::calc_kinetic_J() const {
  return models::calc_kinetic_J(calc_effective_mass_kg(), now().motion.speed_m_s);
}

template <class S>
S QuasiStaticDrum<S>::calc_spring_J() const {
  return models::calc_tire_spring_J(context().tire, now().motion.load_N);
}

template <class S>
void QuasiStaticDrum<S>::evaluate(double time_s, const S* state, S* rates, S* integrands) {
  find_motion(time_s, state);
  rates[kSpeedState] = now().motion.acceleration_m_s2;
  this->calc_rates(wheels_.front(), state, rates);
  fill_integrands(integrands);
}

template <class S>
void QuasiStaticDrum<S>::fill_integrands(S* integrands) const {
  put_drum_readings(now(), motor_torque_Nm_, integrands);
  if (detail_ == Detail::kMeasured) return;
  const models::Motion<S>& motion = now().motion;
  DrumPowers<S> power;
  power.motor_W = motor_torque_Nm_ * motion.speed_m_s / context().machine_radius_m;
  power.tire_W = now().rolling_resistance_N * motion.rolling_speed_m_s;
  power.bearing_W = now().parasitic_N * motion.speed_m_s;
  put_drum_powers(now(), power, integrands);
}

template <class S>
S QuasiStaticDrum<S>::find_recorded_speed_m_s(double time_s, const S* state) {
  find_motion(time_s, state);
  return models::calc_recorded_speed_m_s(now().motion.speed_m_s, now().recorded, now().acting);
}

template <class S>
void QuasiStaticDrum<S>::observe(double time_s, const S* state, S* values) {
  if (detail_ == Detail::kMeasured) return;
  models::InputPort<S> recorded;
  read_drum_inputs(present_, time_s, recorded);
  *values++ = present_.drive_on ? recorded.speed_m_s : find_recorded_speed_m_s(time_s, state);
  *values++ = recorded.load_N;
  *values++ = recorded.ambient_K;
  if (present_.surface_recorded) *values++ = recorded.surface_K;
  this->put_further_states(wheels_.front(), state, values);
}

template <class S>
void QuasiStaticDrum<S>::calc_stored(double time_s, const S* state, S* stored_J) {
  if (detail_ == Detail::kMeasured) return;
  find_motion(time_s, state);
  stored_J[index_of(RigStore::kKinetic)] = calc_kinetic_J();
  stored_J[index_of(RigStore::kGravity)] = zero<S>();
  stored_J[index_of(RigStore::kSprings)] = calc_spring_J();
  stored_J[index_of(RigStore::kSlipSpring)] = zero<S>();
  stored_J[index_of(RigStore::kHeat)] = this->calc_stored_heat_J(state);
}

template class QuasiStaticDrum<double>;
template class QuasiStaticDrum<Jet>;

}  // namespace rollrig::rigs
