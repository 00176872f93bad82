#include "rigs/recorded_road.h"

#include <numeric>
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

template <class S>
std::vector<models::Corner<S>*> find_corners(const std::vector<RoadTireGroup<S>>& groups) {
  std::vector<models::Corner<S>*> corners;
  for (const RoadTireGroup<S>& group : groups) corners.push_back(group.corner);
  return corners;
}

}  // namespace

template <class S>
RecordedRoad<S>::RecordedRoad(std::vector<RoadTireGroup<S>> tires, const VehiclePowertrain& powertrain,
                              RigStart<S> start, Detail detail)
    : RecordedWheel<S>(find_corners(tires), std::move(start), false, make_road_channels(detail), detail),
      groups_(std::move(tires)),
      motor_limit_N_(body().mass_kg * S(powertrain.regeneration_limit_m_s2)),
      fade_m_s_(powertrain.regeneration_fade_m_s) {
  this->group_sizes_.clear();
  for (const RoadTireGroup<S>& group : groups_) this->group_sizes_.push_back(group.count);
  this->tires_ = std::accumulate(this->group_sizes_.begin(), this->group_sizes_.end(), 0.0);
}

template <class S>
void RecordedRoad<S>::initialize(const sim::Segment& first, double time_s, S* state) {
  RecordedWheel<S>::initialize(first, time_s, state);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const RoadTireGroup<S>& group = groups_[i];
    auto& wheel = this->wheels_[i];
    wheel.now.inflation = this->start_.inflation(group.pressure_Pa);
    group.corner->initialize(group.temperature_K, this->start_.history_under(group.load_N), state + wheel.first_state);
  }
}

template <class S>
void RecordedRoad<S>::read_inputs(double time_s, std::size_t wheel, models::InputPort<S>& inputs) const {
  read_vehicle_inputs(this->present_, time_s, inputs);
  inputs.load_N = groups_[wheel].load_N;
}

template <class S>
void RecordedRoad<S>::find_force() {
  const models::Instant<S>& now = this->wheel().now;  // of the vehicle, every wheel says the same
  S rolling_N = this->group_sizes_[0] * (now.rolling_resistance_N + now.parasitic_N);
  for (std::size_t i = 1; i < groups_.size(); ++i) {
    const models::Instant<S>& other = this->wheels_[i].now;
    rolling_N += this->group_sizes_[i] * (other.rolling_resistance_N + other.parasitic_N);
  }
  const double density_kg_per_m3 =
      models::calc_air_density_kg_per_m3(kStandardAtmosphere_Pa, value_of(now.recorded.ambient_K));
  mass_kg_ = now.contact.vehicle_mass_factor * (body().mass_kg + body().rotating_mass_kg);
  grade_N_ = models::calc_grade_N(body().mass_kg, now.acting.slope);
  drag_N_ = models::calc_drag_N(S(now.acting.air_density_ratio * density_kg_per_m3), body().drag_area_m2,
                                now.motion.speed_m_s, now.acting.wind_m_s);
  const S traction_N = rolling_N + grade_N_ + drag_N_ + mass_kg_ * now.motion.acceleration_m_s2;
  const auto demand = models::blend_brakes(traction_N, motor_limit_N_, now.motion.speed_m_s, fade_m_s_);
  for (auto& wheel : this->wheels_) {
    wheel.now.acting.brake_force_N = demand.friction_N / this->tires_;
    wheel.now.acting.longitudinal_force_N = traction_N / this->tires_;
    this->put_contact_force(wheel, S(-wheel.now.acting.longitudinal_force_N));
  }
  this->force_N_ = traction_N;
}

template <class S>
RecordedPowers<S> RecordedRoad<S>::find_powers() const {
  const S& speed_m_s = this->wheel().now.motion.speed_m_s;
  RecordedPowers<S> power;
  power.moving_kg = mass_kg_;
  power.gravity_W = -grade_N_ * speed_m_s;
  power.drag_W = drag_N_ * speed_m_s;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const models::Instant<S>& now = this->wheels_[i].now;
    const double count = this->group_sizes_[i];
    power.hub_W += count / this->tires_ * this->force_N_ * speed_m_s * (S(1.0) - this->wheels_[i].slip);
    power.tire_W += count * now.rolling_resistance_N * speed_m_s;
    power.slip_W += count * now.motion.slip_power_W;
    power.bearing_W += count * now.parasitic_N * speed_m_s;
  }
  return power;
}

template class RecordedRoad<double>;
template class RecordedRoad<Jet>;

}  // namespace rollrig::rigs
