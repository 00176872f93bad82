#include "rigs/quasi_static_vehicle.h"

#include <algorithm>
#include <type_traits>

namespace rollrig::rigs {

template <class S>
QuasiStaticVehicle<S>::QuasiStaticVehicle(std::vector<models::Corner<S>>& corners, const VehicleLayout& layout,
                                          RigStart<S> start, bool surface_recorded)
    : Base({make_vehicle_integrals(layout), make_vehicle_stores(),
            make_vehicle_channels(layout, corners, surface_recorded)},
           list_corners(corners), 1, std::move(start), surface_recorded),
      layout_(layout),
      hubs_(layout.wheels.size()) {}

template <class S>
void QuasiStaticVehicle<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  present_.take(first, time_s);
  present_.drive_on = true;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    this->begin_wheel(wheels_[i], S(layout_.wheels[i].static_load_N), state);
    wheels_[i].now.inflation = this->start_.inflation(layout_.wheels[i].pressure_Pa);
  }
  find_motion(time_s, state);
  state[kSpeedState] = speed_m_s_;
}

template <class S>
void QuasiStaticVehicle<S>::begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) {
  present_.take(segment, time_s);
  const double start_m_s = segment.inputs[index_of(VehicleInput::kSpeed)].start;  // as recorded
  if (!present_.drive_on || start_m_s == value_of(state[kSpeedState])) return;
  const S former_m_s = state[kSpeedState];
  find_motion(time_s, state);
  state[kSpeedState] = speed_m_s_;
  const S moving_kg = body_mass_kg_ + calc_wheel_inertia_kg();
  integrals[index_of(VehicleIntegral::kKnotWork)] +=
      0.5 * moving_kg * (speed_m_s_ * speed_m_s_ - former_m_s * former_m_s);
}

/// Forces against the vehicle beside its tires, and the mass that they move.
template <class S>
void QuasiStaticVehicle<S>::find_resistance() {
  const models::Instant<S>& now = wheels_.front().now;
  const auto& load = layout_.resistance;
  const models::RoadLoad<S> resistance{S(load.A_N), S(load.B_N_s_per_m), S(load.C_N_s2_per_m2)};
  const S load_N = models::calc_faded_road_load_N(resistance, speed_m_s_);
  const S total_mass_kg = now.contact.vehicle_mass_factor * S(layout_.mass_kg + layout_.rotating_mass_kg);
  body_mass_kg_ = total_mass_kg - calc_wheel_inertia_kg();
  if (is_on_road()) {
    given_force_N_ = models::calc_grade_N(S(layout_.mass_kg), now.acting.slope);
    rolled_off_N_ = given_force_N_ + load_N +
                    calc_air_drag_N(layout_, now.acting.air_density_ratio, speed_m_s_, now.acting.wind_m_s);
    return;
  }
  given_force_N_ = load_N;
  rolled_off_N_ = load_N;
  for (const Wheel& wheel : wheels_) {
    const S nominal_N = models::calc_faded_parasitic_N(wheel.now.context->parasitic, speed_m_s_);
    given_force_N_ -= nominal_N;  // rollers make up for their own bearings
    rolled_off_N_ += wheel.now.parasitic_N - nominal_N;
  }
}

template <class S>
S QuasiStaticVehicle<S>::calc_wheel_inertia_kg() const {
  S sum_kg = zero<S>();
  for (const Wheel& wheel : wheels_) sum_kg += wheel.rolling.spin_mass_kg;
  return sum_kg;
}

/// Demand and acceleration, whichever is asked for, at the present slip.
template <class S>
void QuasiStaticVehicle<S>::find_balance() {
  S resistance_N = rolled_off_N_;
  S inertia_kg = body_mass_kg_;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    resistance_N += wheels_[i].now.rolling_resistance_N + hubs_[i].loss_N;
    inertia_kg += wheels_[i].rolling.calc_carried_mass_kg(wheels_[i].slip);
  }
  const bool drives = present_.drive_on;
  acceleration_m_s2_ = drives ? wheels_.front().now.acting.acceleration_m_s2 : S(-resistance_N / inertia_kg);
  demand_N_ = drives ? S(resistance_N + inertia_kg * acceleration_m_s2_) : zero<S>();
}

/// What of the demand each simulated wheel does, and what the rest of the vehicle.
template <class S>
void QuasiStaticVehicle<S>::share_demand() {
  const models::ForceDemand<S> demand =
      present_.drive_on && models::is_held(wheels_.front().now.acting)
          ? models::ForceDemand<S>{demand_N_, zero<S>()}
          : models::blend_brakes(demand_N_, S(layout_.motor_limit_N), speed_m_s_, S(layout_.regeneration_fade_m_s));
  motor_N_ = demand.motor_N;
  assist_N_ = demand_N_;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& wheel = wheels_[i];
    Hub& hub = hubs_[i];
    hub.motor_N = layout_.wheels[i].motor_share * demand.motor_N;
    hub.friction_N = layout_.wheels[i].friction_share * demand.friction_N;
    assist_N_ -= hub.motor_N - hub.friction_N;
    wheel.now.motion.longitudinal_force_N =
        wheel.rolling.calc_balance_N(hub.loss_N, acceleration_m_s2_, wheel.slip) - hub.motor_N + hub.friction_N;
  }
}

template <class S>
void QuasiStaticVehicle<S>::find_motion(double time_s, const S* state) {
  models::InputPort<S> recorded;
  read_vehicle_inputs(present_, time_s, recorded);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& wheel = wheels_[i];
    wheel.now.recorded = recorded;
    wheel.now.recorded.load_N = S(layout_.wheels[i].static_load_N);
    this->apply_inputs(wheel, state);
    if (i == 0) speed_m_s_ = present_.drive_on ? wheel.now.acting.speed_m_s : state[kSpeedState];
    this->find_losses(wheel, speed_m_s_, state);
    wheel.slip = zero<S>();
    hubs_[i].loss_N = is_on_road() ? wheel.now.parasitic_N : zero<S>();
  }
  find_resistance();
  find_balance();
  share_demand();
  const bool has_derivatives = !std::is_same_v<S, double>;  // slip's own derivative does not vanish with slip
  const auto slips = [](const Wheel& wheel) { return value_of(wheel.now.contact.slip_compliance_per_N) > 0.0; };
  if (has_derivatives || std::any_of(wheels_.begin(), wheels_.end(), slips)) {
    // From the forces without slip, which differ from those with it in the second order.
    for (Wheel& wheel : wheels_) wheel.slip = models::calc_slip(wheel.now);
    find_balance();
    share_demand();
  }
  for (std::size_t i = 0; i < wheels_.size(); ++i) find_wheel(i);
}

/// A wheel's motion and its hub's force, now that they are known.
template <class S>
void QuasiStaticVehicle<S>::find_wheel(std::size_t i) {
  models::Instant<S>& now = wheels_[i].now;
  now.motion.acceleration_m_s2 = acceleration_m_s2_;
  models::put_slip(wheels_[i].rolling, wheels_[i].slip, now.motion);
  now.recorded.longitudinal_force_N = hubs_[i].motor_N - hubs_[i].friction_N;
  now.recorded.brake_force_N = hubs_[i].friction_N;
  now.acting.longitudinal_force_N = now.recorded.longitudinal_force_N;
  now.acting.brake_force_N = hubs_[i].friction_N;
}

template <class S>
void QuasiStaticVehicle<S>::evaluate(double time_s, const S* state, S* rates, S* integrands) {
  find_motion(time_s, state);
  rates[kSpeedState] = acceleration_m_s2_;
  for (Wheel& wheel : wheels_) this->calc_rates(wheel, state, rates);
  fill_vehicle_integrands(integrands);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const models::Instant<S>& now = wheels_[i].now;
    const S slip_N = now.motion.longitudinal_force_N * wheels_[i].slip;
    put_wheel_integrands(present_, now, models::calc_loss_force_N(now, slip_N, acceleration_m_s2_),
                         &integrands[index_of(WheelIntegral::kLossForce, i)]);
  }
}

template <class S>
void QuasiStaticVehicle<S>::fill_vehicle_integrands(S* integrands) const {
  VehiclePowers<S> power;
  double own_share = 0.0;  // of the motor, at the simulated hubs
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const models::Instant<S>& now = wheels_[i].now;
    const S rim_m_s = speed_m_s_ * (S(1.0) - wheels_[i].slip);
    own_share += layout_.wheels[i].motor_share;
    power.motor_W += hubs_[i].motor_N * rim_m_s;
    power.brake_W += hubs_[i].friction_N * rim_m_s;
    power.tire_W += now.rolling_resistance_N * now.motion.rolling_speed_m_s;
    power.bearing_W += is_on_road() ? S(hubs_[i].loss_N * rim_m_s) : S(now.parasitic_N * speed_m_s_);
    power.add_slip_and_heat(now);
  }
  power.roller_W = (assist_N_ - given_force_N_) * speed_m_s_;
  power.drive_W = own_share > 0.0 ? S(power.motor_W / own_share) : S(motor_N_ * speed_m_s_);
  if (is_on_road()) power.drag_W = (rolled_off_N_ - given_force_N_) * speed_m_s_;
  put_vehicle_integrands(present_, demand_N_, speed_m_s_, power, integrands);
  put_battery_integrand(layout_, speed_m_s_, power.drive_W, integrands);
}

template <class S>
S QuasiStaticVehicle<S>::find_recorded_speed_m_s(double time_s, const S* state) {
  find_motion(time_s, state);
  return models::calc_recorded_speed_m_s(speed_m_s_, wheels_.front().now.recorded, wheels_.front().now.acting);
}

template <class S>
void QuasiStaticVehicle<S>::observe(double time_s, const S* state, S* values) {
  models::InputPort<S> recorded;
  read_vehicle_inputs(present_, time_s, recorded);
  *values++ = present_.drive_on ? recorded.speed_m_s : find_recorded_speed_m_s(time_s, state);
  *values++ = recorded.ambient_K;
  if (present_.surface_recorded) *values++ = recorded.surface_K;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    *values++ = S(layout_.wheels[i].static_load_N);
    values = this->put_further_states(wheels_[i], state, values);
  }
}

template <class S>
void QuasiStaticVehicle<S>::calc_stored(double time_s, const S* state, S* stored_J) {
  find_motion(time_s, state);
  std::fill_n(stored_J, index_of(RigStore::kCount), zero<S>());
  stored_J[index_of(RigStore::kKinetic)] =
      models::calc_kinetic_J(S(body_mass_kg_ + calc_wheel_inertia_kg()), speed_m_s_);
  stored_J[index_of(RigStore::kHeat)] = this->calc_stored_heat_J(state);
}

template class QuasiStaticVehicle<double>;
template class QuasiStaticVehicle<Jet>;

}  // namespace rollrig::rigs
