#include "rigs/recorded_road.h"

#include <utility>

#include "models/vehicle/vehicle.h"

namespace rollrig::rigs {
namespace {

namespace quantities = models::quantities;

std::vector<sim::Channel> make_road_channels(Detail detail) {
  const sim::Channel traction = make_mean_channel(quantities::kTractionForce, RecordedIntegral::kForce);
  if (detail == Detail::kMeasured) return {traction};
  return {traction,
          make_mean_channel(quantities::kRollingResistance, RecordedIntegral::kRollingResistance),
          make_mean_channel(quantities::kParasiticLoss, RecordedIntegral::kParasitic),
          make_tire_channel(quantities::kLinerTemperature),
          make_tire_channel(quantities::kCavityPressure),
          make_mean_channel(quantities::kFrictionBrake, RecordedIntegral::kFrictionBrake)};
}

}  // namespace

template <class S>
RecordedRoad<S>::RecordedRoad(models::Corner<S>& corner, const VehicleFile& vehicle, RigStart<S> start,
                              const S& temperature_K, Detail detail)
    : RecordedWheel<S>(corner, std::move(start), false, make_road_channels(detail), detail),
      temperature_K_(temperature_K),
      load_N_(body().mass_kg * S(kStandardGravity_m_s2 / vehicle.count_wheels())),
      motor_limit_N_(body().mass_kg * S(vehicle.powertrain.regeneration_limit_m_s2)),
      fade_m_s_(vehicle.powertrain.regeneration_fade_m_s) {
  this->wheels_alike_ = vehicle.count_wheels();
}

template <class S>
void RecordedRoad<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  RecordedWheel<S>::initialize(first, time_s, state);
  this->wheel().corner->initialize(temperature_K_, this->start_.history_under(load_N_), state);
}

template <class S>
void RecordedRoad<S>::read_inputs(double time_s, models::InputPort<S>& inputs) const {
  read_vehicle_inputs(this->present_, time_s, inputs);
  inputs.load_N = load_N_;
}

template <class S>
void RecordedRoad<S>::find_force() {
  models::Instant<S>& now = this->wheel().now;
  const double tires = this->wheels_alike_;
  const double density_kg_per_m3 =
      models::calc_air_density_kg_per_m3(kStandardAtmosphere_Pa, value_of(now.recorded.ambient_K));
  mass_kg_ = now.contact.vehicle_mass_factor * (body().mass_kg + body().rotating_mass_kg);
  grade_N_ = models::calc_grade_N(body().mass_kg, now.acting.slope);
  drag_N_ = models::calc_drag_N(S(now.acting.air_density_ratio * density_kg_per_m3), body().drag_area_m2,
                                now.motion.speed_m_s, now.acting.wind_m_s);
  const S traction_N = tires * (now.rolling_resistance_N + now.parasitic_N) + grade_N_ + drag_N_ +
                       mass_kg_ * now.motion.acceleration_m_s2;
  const auto demand = models::blend_brakes(traction_N, motor_limit_N_, now.motion.speed_m_s, fade_m_s_);
  now.acting.brake_force_N = demand.friction_N / tires;
  now.acting.longitudinal_force_N = traction_N / tires;
  this->put_contact_force(S(-now.acting.longitudinal_force_N));
  this->force_N_ = traction_N;
}

template <class S>
RecordedPowers<S> RecordedRoad<S>::find_powers() const {
  const models::Instant<S>& now = this->wheel().now;
  const double tires = this->wheels_alike_;
  const S& speed_m_s = now.motion.speed_m_s;
  RecordedPowers<S> power;
  power.moving_kg = mass_kg_;
  power.hub_W = this->force_N_ * speed_m_s * (S(1.0) - this->wheel().slip);
  power.gravity_W = -grade_N_ * speed_m_s;
  power.tire_W = tires * now.rolling_resistance_N * speed_m_s;
  power.slip_W = tires * now.motion.slip_power_W;
  power.bearing_W = tires * now.parasitic_N * speed_m_s;
  power.drag_W = drag_N_ * speed_m_s;
  return power;
}

template class RecordedRoad<double>;
template class RecordedRoad<Jet>;

}  // namespace rollrig::rigs
