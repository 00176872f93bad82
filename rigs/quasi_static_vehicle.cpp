#include "rigs/quasi_static_vehicle.h"

#include <stdexcept>
#include <type_traits>
#include <utility>

namespace rollrig::rigs {

using models::Node;

template <class S>
QuasiStaticVehicle<S>::QuasiStaticVehicle(std::vector<models::Corner<S>>& corners, const VehicleLayout& layout,
                                          VehicleStart<S> start, bool surface_recorded)
    : corners_(corners),
      layout_(layout),
      start_(std::move(start)),
      surface_recorded_(surface_recorded),
      integrals_(make_vehicle_integrals(layout)),
      stores_(make_vehicle_stores()),
      channels_(make_vehicle_channels(layout, corners.front().states(), surface_recorded)),
      wheels_(layout.wheels.size()) {}

template <class S>
std::vector<double> QuasiStaticVehicle<S>::state_tolerances() const {
  std::vector<double> tolerances{1.0};
  for (const auto& corner : corners_) {
    for (const models::CornerState& state : corner.states()) tolerances.push_back(state.scale_SI);
  }
  return tolerances;
}

template <class S>
void QuasiStaticVehicle<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  segment_ = first;
  segment_start_s_ = time_s;
  driver_on_ = true;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i] = {};
    wheels_[i].now.inflation = start_.inflation();
    const S load_N(layout_.wheels[i].static_load_N);
    corners_[i].initialize(start_.tire_temperature_K, start_.history_under(load_N), state + first_state_of(i));
  }
  find_motion(time_s, state);
  state[kSpeedState] = speed_m_s_;
}

template <class S>
void QuasiStaticVehicle<S>::begin_phase(const sim::Phase& phase, double, S* state) {
  for (const sim::Command& command : phase.commands) {
    if (command.name == kSetPressure) {
      for (std::size_t i = 0; i < wheels_.size(); ++i) {
        corners_[i].inflate(S(command.value_SI), state + first_state_of(i), wheels_[i].now.inflation);
      }
    } else if (command.name == kDriver) {
      driver_on_ = command.value_SI != 0.0;
    } else {
      throw std::invalid_argument("vehicle: unknown command " + command.name);
    }
  }
}

template <class S>
void QuasiStaticVehicle<S>::begin_segment(const sim::Segment& segment, double time_s, S* state, S* integrals) {
  segment_ = segment;
  segment_start_s_ = time_s;
  const double start_m_s = segment.inputs[index_of(VehicleInput::kSpeed)].start;  // as recorded
  if (!driver_on_ || start_m_s == value_of(state[kSpeedState])) return;
  const S former_m_s = state[kSpeedState];
  find_motion(time_s, state);
  state[kSpeedState] = speed_m_s_;
  const S moving_kg = body_mass_kg_ + calc_wheel_inertia_kg();
  integrals[index_of(VehicleIntegral::kKnotWork)] +=
      0.5 * moving_kg * (speed_m_s_ * speed_m_s_ - former_m_s * former_m_s);
}

/// Ports up to the losses of one wheel at the common speed.
template <class S>
void QuasiStaticVehicle<S>::find_losses(std::size_t i, const S* state, const models::InputPort<S>& recorded) {
  Wheel& wheel = wheels_[i];
  const models::Corner<S>& corner = corners_[i];
  const S* x = state + first_state_of(i);
  wheel.now.recorded = recorded;
  wheel.now.recorded.load_N = S(layout_.wheels[i].static_load_N);
  corner.apply_inputs(x, wheel.now);
  if (i == 0) speed_m_s_ = driver_on_ ? wheel.now.acting.speed_m_s : state[kSpeedState];
  wheel.now.motion = {};  // forces and slip come after the losses, see docs/ports.md
  wheel.now.motion.acceleration_m_s2 = wheel.now.acting.acceleration_m_s2;
  wheel.now.motion.speed_m_s = speed_m_s_;
  wheel.now.motion.load_N = wheel.now.acting.load_N;
  corner.calc_losses(x, wheel.now);
  wheel.rolling = models::find_rolling_wheel(wheel.now);
  wheel.hub_loss_N = layout_.rig_kind == RigKind::kFlat ? wheel.now.parasitic_N : zero<S>();
  wheel.slip = zero<S>();
}

/// Forces against the vehicle beside its tires, and the mass that they move.
template <class S>
void QuasiStaticVehicle<S>::find_resistance() {
  const models::Instant<S>& now = wheels_.front().now;
  const S fade = models::calc_standstill_fade(speed_m_s_);
  const auto& load = layout_.resistance;
  const models::RoadLoad<S> resistance{S(load.A_N), S(load.B_N_s_per_m), S(load.C_N_s2_per_m2)};
  const S load_N = fade * models::calc_road_load_N(resistance, speed_m_s_);
  const S total_mass_kg = now.contact.vehicle_mass_factor * S(layout_.mass_kg + layout_.rotating_mass_kg);
  body_mass_kg_ = total_mass_kg - calc_wheel_inertia_kg();
  if (layout_.rig_kind == RigKind::kFlat) {
    given_force_N_ = models::calc_grade_N(S(layout_.mass_kg), now.acting.slope);
    const S density_kg_per_m3 = layout_.air_density_kg_per_m3 * now.acting.air_density_ratio;
    rolled_off_N_ = given_force_N_ + load_N +
                    models::calc_drag_N(density_kg_per_m3, S(layout_.drag_area_m2), speed_m_s_, now.acting.wind_m_s);
    return;
  }
  given_force_N_ = load_N;
  rolled_off_N_ = load_N;
  for (const Wheel& wheel : wheels_) {
    const S nominal_N = fade * models::calc_parasitic_N(wheel.now.context->parasitic, speed_m_s_);
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
  for (const Wheel& wheel : wheels_) {
    resistance_N += wheel.now.rolling_resistance_N + wheel.hub_loss_N;
    inertia_kg += wheel.rolling.spin_mass_kg / (S(1.0) - wheel.slip);
  }
  acceleration_m_s2_ = driver_on_ ? wheels_.front().now.acting.acceleration_m_s2 : S(-resistance_N / inertia_kg);
  demand_N_ = driver_on_ ? S(resistance_N + inertia_kg * acceleration_m_s2_) : zero<S>();
}

/// What of the demand each simulated wheel does, and what the rest of the vehicle.
template <class S>
void QuasiStaticVehicle<S>::share_demand() {
  const models::ForceDemand<S> demand =
      driver_on_ && models::is_held(wheels_.front().now.acting)
          ? models::ForceDemand<S>{demand_N_, zero<S>()}
          : models::blend_brakes(demand_N_, S(layout_.motor_limit_N), speed_m_s_, S(layout_.regeneration_fade_m_s));
  motor_N_ = demand.motor_N;
  assist_N_ = demand_N_;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& wheel = wheels_[i];
    wheel.motor_N = layout_.wheels[i].motor_share * demand.motor_N;
    wheel.friction_N = layout_.wheels[i].friction_share * demand.friction_N;
    assist_N_ -= wheel.motor_N - wheel.friction_N;
    wheel.now.motion.longitudinal_force_N =
        wheel.rolling.calc_balance_N(wheel.hub_loss_N, acceleration_m_s2_, wheel.slip) - wheel.motor_N +
        wheel.friction_N;
  }
}

template <class S>
void QuasiStaticVehicle<S>::find_slip() {
  for (Wheel& wheel : wheels_) wheel.slip = models::calc_slip(wheel.now);
}

template <class S>
void QuasiStaticVehicle<S>::find_motion(double time_s, const S* state) {
  const models::InputPort<S> recorded = read_vehicle_inputs<S>(segment_, time_s - segment_start_s_, surface_recorded_);
  for (std::size_t i = 0; i < wheels_.size(); ++i) find_losses(i, state, recorded);
  find_resistance();
  find_balance();
  share_demand();
  const bool has_derivatives = !std::is_same_v<S, double>;  // slip's own derivative does not vanish with slip
  if (has_derivatives || value_of(wheels_.front().now.contact.slip_compliance_per_N) > 0.0) {
    find_slip();  // from the forces without slip, which differ from those with it in the second order
    find_balance();
    share_demand();
  }
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& wheel = wheels_[i];
    wheel.now.motion.acceleration_m_s2 = acceleration_m_s2_;
    models::put_slip(wheel.rolling, wheel.slip, wheel.now.motion);
    wheel.now.recorded.longitudinal_force_N = wheel.motor_N - wheel.friction_N;
    wheel.now.recorded.brake_force_N = wheel.friction_N;
    wheel.now.acting.longitudinal_force_N = wheel.now.recorded.longitudinal_force_N;
    wheel.now.acting.brake_force_N = wheel.friction_N;
  }
}

template <class S>
void QuasiStaticVehicle<S>::evaluate(double time_s, const S* state, S* rates, S* integrands) {
  find_motion(time_s, state);
  rates[kSpeedState] = acceleration_m_s2_;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    corners_[i].calc_rates(state + first_state_of(i), wheels_[i].now, rates + first_state_of(i));
  }
  fill_vehicle_integrands(integrands);
  for (std::size_t i = 0; i < wheels_.size(); ++i) fill_wheel_integrands(i, integrands);
}

template <class S>
void QuasiStaticVehicle<S>::fill_vehicle_integrands(S* integrands) const {
  using std::abs;
  const auto put = [integrands](VehicleIntegral integral, const S& value) { integrands[index_of(integral)] = value; };
  const S counted = S(segment_.inputs[index_of(VehicleInput::kCounted)].start);
  double own_share = 0.0;  // of the motor, at the simulated hubs
  S motor_W = zero<S>(), tire_W = zero<S>(), slip_W = zero<S>(), bearing_W = zero<S>(), brake_W = zero<S>();
  S heat_in_W = zero<S>(), to_air_W = zero<S>(), to_road_W = zero<S>();
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const Wheel& wheel = wheels_[i];
    own_share += layout_.wheels[i].motor_share;
    const S rim_m_s = speed_m_s_ * (S(1.0) - wheel.slip);
    motor_W += wheel.motor_N * rim_m_s;
    brake_W += wheel.friction_N * rim_m_s;
    tire_W += wheel.now.rolling_resistance_N * wheel.now.motion.rolling_speed_m_s;
    slip_W += wheel.now.motion.slip_power_W;
    bearing_W +=
        layout_.rig_kind == RigKind::kFlat ? S(wheel.hub_loss_N * rim_m_s) : S(wheel.now.parasitic_N * speed_m_s_);
    heat_in_W += wheel.now.heat.heat_in_W;
    to_air_W += wheel.now.heat.to_air_W;
    to_road_W += wheel.now.heat.to_road_W;
  }
  const S roller_W = (assist_N_ - given_force_N_) * speed_m_s_;
  const S drive_W = own_share > 0.0 ? S(motor_W / own_share) : S(motor_N_ * speed_m_s_);
  const bool drives = value_of(drive_W) > 0.0;
  const bool flat = layout_.rig_kind == RigKind::kFlat;
  put(VehicleIntegral::kTraction, demand_N_);
  put(VehicleIntegral::kDistance, speed_m_s_);
  put(VehicleIntegral::kCountedTime, counted);
  put(VehicleIntegral::kCountedDistance, counted * speed_m_s_);
  put(VehicleIntegral::kDriveEnergy, drives ? drive_W : zero<S>());
  put(VehicleIntegral::kRecuperated, drives ? zero<S>() : S(-drive_W));
  put(VehicleIntegral::kDriveWork, motor_W);
  put(VehicleIntegral::kRollerWork, roller_W);
  put(VehicleIntegral::kThroughput, S(abs(motor_W)) + S(abs(roller_W)));
  put(VehicleIntegral::kKnotWork, zero<S>());
  put(VehicleIntegral::kTireLoss, tire_W);
  put(VehicleIntegral::kSlipLoss, slip_W);
  put(VehicleIntegral::kBearingLoss, bearing_W);
  put(VehicleIntegral::kBrakeLoss, brake_W);
  put(VehicleIntegral::kDragLoss, flat ? S((rolled_off_N_ - given_force_N_) * speed_m_s_) : zero<S>());
  put(VehicleIntegral::kTireDamperLoss, zero<S>());
  put(VehicleIntegral::kSuspensionDamperLoss, zero<S>());
  put(VehicleIntegral::kHeatGenerated, heat_in_W);
  put(VehicleIntegral::kHeatToAir, to_air_W);
  put(VehicleIntegral::kHeatToRoad, to_road_W);
}

template <class S>
void QuasiStaticVehicle<S>::fill_wheel_integrands(std::size_t i, S* integrands) const {
  const Wheel& wheel = wheels_[i];
  const models::Instant<S>& now = wheel.now;
  const auto put = [&](WheelIntegral integral, const S& value) { integrands[index_of(integral, i)] = value; };
  const S counted = S(segment_.inputs[index_of(VehicleInput::kCounted)].start);
  const S rolling_W = now.rolling_resistance_N * now.motion.rolling_speed_m_s;
  put(WheelIntegral::kLossForce,
      models::calc_loss_force_N(now, S(now.motion.longitudinal_force_N * wheel.slip), acceleration_m_s2_));
  put(WheelIntegral::kLinerTemperature, now.thermal.temperature_K[models::index_of(Node::kRubber)]);
  put(WheelIntegral::kCavityPressure, now.pressure_Pa);
  put(WheelIntegral::kGasTemperature, now.thermal.temperature_K[models::index_of(Node::kGas)]);
  put(WheelIntegral::kRollingResistance, now.rolling_resistance_N);
  put(WheelIntegral::kParasitic, now.parasitic_N);
  put(WheelIntegral::kLongitudinalForce, now.recorded.longitudinal_force_N);
  put(WheelIntegral::kContactLoad, now.motion.load_N);
  put(WheelIntegral::kRollingEnergy, rolling_W);
  put(WheelIntegral::kCountedRollingEnergy, counted * rolling_W);
  put(WheelIntegral::kCountedRrc, counted * now.rolling_resistance_N / now.motion.load_N);
}

template <class S>
void QuasiStaticVehicle<S>::require_possible(const S* state) const {
  for (std::size_t i = 0; i < wheels_.size(); ++i) corners_[i].require_possible(state + first_state_of(i));
}

template <class S>
S QuasiStaticVehicle<S>::watch(const std::string& name, double time_s, const S* state) {
  if (name == kWatchTireTemperature) return state[first_state_of(0) + corners_.front().state_of(Node::kRubber)];
  if (name != kWatchSpeed) throw std::invalid_argument("vehicle: cannot watch " + name);
  find_motion(time_s, state);
  return find_recorded_speed_m_s();
}

template <class S>
void QuasiStaticVehicle<S>::observe(double time_s, const S* state, S* values) {
  find_motion(time_s, state);
  const models::InputPort<S>& recorded = wheels_.front().now.recorded;
  *values++ = driver_on_ ? recorded.speed_m_s : find_recorded_speed_m_s();
  *values++ = recorded.ambient_K;
  if (surface_recorded_) *values++ = recorded.surface_K;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    *values++ = wheels_[i].now.recorded.load_N;
    for (std::size_t k = 2; k < corners_[i].state_count(); ++k) *values++ = state[first_state_of(i) + k];
  }
}

/// Kinetic energy in the motion found last.
template <class S>
S QuasiStaticVehicle<S>::calc_kinetic_J() const {
  return 0.5 * (body_mass_kg_ + calc_wheel_inertia_kg()) * speed_m_s_ * speed_m_s_;
}

template <class S>
void QuasiStaticVehicle<S>::calc_stored(double time_s, const S* state, S* stored_J) {
  find_motion(time_s, state);
  for (std::size_t i = 0; i < stores_.size(); ++i) stored_J[i] = zero<S>();
  stored_J[index_of(VehicleStore::kKinetic)] = calc_kinetic_J();
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    stored_J[index_of(VehicleStore::kHeat)] += corners_[i].calc_stored_heat_J(state + first_state_of(i));
  }
}

template class QuasiStaticVehicle<double>;
template class QuasiStaticVehicle<Jet>;

}  // namespace rollrig::rigs
