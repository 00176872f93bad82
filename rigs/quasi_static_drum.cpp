#include "rigs/quasi_static_drum.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace rollrig::rigs {

using models::Node;

template <class S>
QuasiStaticDrum<S>::QuasiStaticDrum(models::Corner<S>& corner, DrumStart<S> start, bool surface_recorded, Detail detail)
    : corner_(corner),
      start_(std::move(start)),
      surface_recorded_(surface_recorded),
      detail_(detail),
      integrals_(make_drum_integrals(detail)),
      stores_(make_drum_stores(detail)),
      channels_(make_drum_channels(corner.states(), surface_recorded, detail)) {}

template <class S>
std::vector<double> QuasiStaticDrum<S>::state_tolerances() const {
  std::vector<double> tolerances{1.0};
  for (const models::CornerState& state : corner_.states()) tolerances.push_back(state.scale_SI);
  return tolerances;
}

template <class S>
void QuasiStaticDrum<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  segment_ = first;
  segment_start_s_ = time_s;
  motor_on_ = true;
  now_ = {};
  now_.recorded.air_density_ratio = S(1.0);
  now_.inflation = start_.inflation();
  const S load_N(first.inputs[index_of(DrumInput::kLoad)].start);
  corner_.initialize(start_.tire_temperature_K, start_.history_under(load_N), state + kFirstCornerState);
  find_motion(time_s, state);
  state[kSpeedState] = now_.acting.speed_m_s;
}

template <class S>
void QuasiStaticDrum<S>::begin_phase(const sim::Phase& phase, double, S* state) {
  for (const sim::Command& command : phase.commands) {
    if (command.name == kSetPressure) {
      corner_.inflate(S(command.value_SI), state + kFirstCornerState, now_.inflation);
    } else if (command.name == kMotor) {
      motor_on_ = command.value_SI != 0.0;
    } else {
      throw std::invalid_argument("drum rig: unknown command " + command.name);
    }
  }
}

template <class S>
void QuasiStaticDrum<S>::begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) {
  find_motion(time_s, state);
  const S before_J = calc_mechanical_J();
  segment_ = segment;
  segment_start_s_ = time_s;
  find_motion(time_s, state);
  if (motor_on_) state[kSpeedState] = now_.acting.speed_m_s;
  if (detail_ == Detail::kFull) integrals[index_of(DrumIntegral::kKnotWork)] += calc_mechanical_J() - before_J;
}

/// Fills now_ up to the losses, the wheel and the torque.
template <class S>
void QuasiStaticDrum<S>::find_motion(double time_s, const S* state) {
  const S* x = state + kFirstCornerState;
  read_drum_inputs(segment_, time_s - segment_start_s_, surface_recorded_, now_.recorded);
  corner_.apply_inputs(x, now_);
  models::Motion<S>& motion = now_.motion;
  motion.speed_m_s = motor_on_ ? now_.acting.speed_m_s : state[kSpeedState];
  motion.load_N = now_.acting.load_N;
  corner_.calc_losses(x, now_);
  wheel_ = models::find_rolling_wheel(now_);
  const S resistance_N = now_.rolling_resistance_N + now_.parasitic_N;
  const S effective_mass_kg = calc_effective_mass_kg();
  motion.acceleration_m_s2 = motor_on_ ? now_.acting.acceleration_m_s2 : S(-resistance_N / effective_mass_kg);
  // Slip of the wheel's own making: rolling resistance and the wheel's inertia drag on the contact.
  const S spin_force_N = wheel_.spin_mass_kg * motion.acceleration_m_s2;
  motion.longitudinal_force_N = wheel_.loss_at_wheel_N + spin_force_N;
  const S slip = models::calc_slip(now_);
  models::put_slip(wheel_, slip, motion);
  drum_torque_Nm_ = zero<S>();
  if (motor_on_) {
    drum_torque_Nm_ = (resistance_N + effective_mass_kg * motion.acceleration_m_s2 + slip * spin_force_N) *
                      corner_.context().machine_radius_m;
  }
}

template <class S>
S QuasiStaticDrum<S>::calc_effective_mass_kg() const {
  return now_.contact.machine_inertia_factor * corner_.context().machine_mass_kg + wheel_.spin_mass_kg;
}

/// Kinetic energy of drum and wheel and energy of the tire's spring, in the motion of now_.
template <class S>
S QuasiStaticDrum<S>::calc_mechanical_J() const {
  return 0.5 * calc_effective_mass_kg() * now_.motion.speed_m_s * now_.motion.speed_m_s +
         models::calc_tire_spring_J(corner_.context().tire, now_.motion.load_N);
}

template <class S>
void QuasiStaticDrum<S>::evaluate(double time_s, const S* state, S* rates, S* integrands) {
  find_motion(time_s, state);
  rates[kSpeedState] = now_.motion.acceleration_m_s2;
  corner_.calc_rates(state + kFirstCornerState, now_, rates + kFirstCornerState);
  fill_integrands(integrands);
}

template <class S>
void QuasiStaticDrum<S>::fill_integrands(S* integrands) const {
  const auto put = [integrands](DrumIntegral integral, const S& value) { integrands[index_of(integral)] = value; };
  const S& speed_m_s = now_.motion.speed_m_s;
  put(DrumIntegral::kDrumTorque, drum_torque_Nm_);
  put(DrumIntegral::kLinerTemperature, now_.thermal.temperature_K[models::index_of(Node::kRubber)]);
  put(DrumIntegral::kCavityPressure, now_.pressure_Pa);
  put(DrumIntegral::kGasTemperature, now_.thermal.temperature_K[models::index_of(Node::kGas)]);
  if (detail_ == Detail::kMeasured) return;
  put(DrumIntegral::kRollingResistance, now_.rolling_resistance_N);
  put(DrumIntegral::kParasitic, now_.parasitic_N);
  put(DrumIntegral::kSpindleForce, now_.motion.longitudinal_force_N);
  put(DrumIntegral::kContactLoad, now_.motion.load_N);
  const S motor_W = drum_torque_Nm_ * speed_m_s / corner_.context().machine_radius_m;
  put(DrumIntegral::kMotorWork, motor_W);
  put(DrumIntegral::kMotorThroughput, value_of(motor_W) < 0.0 ? S(-motor_W) : motor_W);
  put(DrumIntegral::kLoadActuatorWork, zero<S>());
  put(DrumIntegral::kKnotWork, zero<S>());
  put(DrumIntegral::kTireLoss, now_.rolling_resistance_N * now_.motion.rolling_speed_m_s);
  put(DrumIntegral::kSlipLoss, now_.motion.slip_power_W);
  put(DrumIntegral::kBearingLoss, now_.parasitic_N * speed_m_s);
  put(DrumIntegral::kTireDamperLoss, zero<S>());
  put(DrumIntegral::kCylinderDamperLoss, zero<S>());
  put(DrumIntegral::kHeatGenerated, now_.heat.heat_in_W);
  put(DrumIntegral::kHeatToAir, now_.heat.to_air_W);
  put(DrumIntegral::kHeatToRoad, now_.heat.to_road_W);
}

template <class S>
void QuasiStaticDrum<S>::require_possible(const S* state) const {
  corner_.require_possible(state + kFirstCornerState);
}

template <class S>
S QuasiStaticDrum<S>::watch(const std::string& name, double time_s, const S* state) {
  if (name == kWatchTireTemperature) return state[kFirstCornerState + corner_.state_of(Node::kRubber)];
  if (name != kWatchSpeed) throw std::invalid_argument("drum rig: cannot watch " + name);
  find_motion(time_s, state);
  return find_recorded_speed_m_s();
}

template <class S>
void QuasiStaticDrum<S>::observe(double time_s, const S* state, S* values) {
  if (detail_ == Detail::kMeasured) return;
  find_motion(time_s, state);
  *values++ = motor_on_ ? now_.recorded.speed_m_s : find_recorded_speed_m_s();
  *values++ = now_.recorded.load_N;
  *values++ = now_.recorded.ambient_K;
  if (surface_recorded_) *values++ = now_.recorded.surface_K;
  for (std::size_t i = 2; i < corner_.state_count(); ++i) *values++ = state[kFirstCornerState + i];
}

template <class S>
void QuasiStaticDrum<S>::calc_stored(double time_s, const S* state, S* stored_J) {
  if (detail_ == Detail::kMeasured) return;
  find_motion(time_s, state);
  const S spring_J = models::calc_tire_spring_J(corner_.context().tire, now_.motion.load_N);
  stored_J[index_of(DrumStore::kTireSpring)] = spring_J;
  stored_J[index_of(DrumStore::kKinetic)] = calc_mechanical_J() - spring_J;
  stored_J[index_of(DrumStore::kGravity)] = zero<S>();
  stored_J[index_of(DrumStore::kSlipSpring)] = zero<S>();
  stored_J[index_of(DrumStore::kHeat)] = corner_.calc_stored_heat_J(state + kFirstCornerState);
}

template class QuasiStaticDrum<double>;
template class QuasiStaticDrum<Jet>;

}  // namespace rollrig::rigs
