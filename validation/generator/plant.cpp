#include "validation/generator/plant.h"

#include <algorithm>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

constexpr double kCvOverR = 2.5;                         // of a gas of two atoms
constexpr double kCreep_m_s = 0.05;                      // Assumed: below it losses fade to nothing
constexpr double kGasConstantOfAir_J_per_kg_K = 287.05;  // dry air; International Standard Atmosphere, ISO 2533

}  // namespace

Plant::Plant(const Specimen& specimen, const Effects& effects, const RunPlan& run)
    : specimen_(specimen),
      effects_(effects),
      run_(run),
      curvature_factor_(specimen.machine->calc_curvature_factor(specimen)),
      follows_law_(!specimen.constant_rrc) {
  for (const Effect& effect : effects_) effect.lay_out(wall_);
  const auto layers = static_cast<double>(wall_.layers);
  for (std::size_t i = 0; i < wall_.layers; ++i) {
    const double depth = (static_cast<double>(i) + 0.5) / layers;  // 0 at the tread, 1 at the liner
    loss_share_.push_back((1.0 + wall_.loss_skew * (1.0 - 2.0 * depth)) / layers);
  }
  gas_mol_ = specimen.truth(Base::kCGas) / (kCvOverR * kGasConstant_J_per_mol_K);
  cavity_m3_ = gas_mol_ * kGasConstant_J_per_mol_K * (run.initial_degC + kZeroCelsius_K) /
               (1e3 * run.cold_pressure_kPa + kStandardAtmosphere_Pa);
  size_ = wall_.layers + 2;  // layers, energy of the gas, amount of the gas
  for (const Effect& effect : effects_) {
    effect_state_.push_back(size_);
    size_ += effect.state_count;
  }
}

std::vector<double> Plant::start() const {
  std::vector<double> state(size_, 0.0);
  std::fill(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(wall_.layers), run_.initial_degC);
  state[wall_.layers] = gas_mol_ * kCvOverR * kGasConstant_J_per_mol_K * (run_.initial_degC + kZeroCelsius_K);
  state[wall_.layers + 1] = gas_mol_;
  RunStart start{run_.initial_degC, run_.air.at(0.0), run_.cold_pressure_kPa, run_.rest_before_min, run_.index, 0.0};
  if (run_.started_warm) start.rest_before_min = 0.0;
  start.first_load_N = run_.legs.front().load_N;
  for (std::size_t i = 0; i < effects_.size(); ++i) effects_[i].start(start, state.data() + effect_state_[i]);
  return state;
}

void Plant::enter(const Leg& leg, double load_before_N, double load_step_s) {
  leg_ = leg;
  load_before_N_ = load_before_N;
  load_step_s_ = load_step_s;
}

/// Load of a cylinder that settles as a damped second-order system.
double Plant::load_at(double time_s) const {
  if (load_before_N_ == leg_.load_N) return std::max(0.0, leg_.load_N);
  constexpr double kSettled = 60.0;  // exp(-60) of a change is less than the rounding of a load
  const double since_s = std::max(0.0, time_s - load_step_s_);
  const double decayed = specimen_.load_damping * specimen_.load_frequency_rad_s * since_s;
  if (leg_.load_N > 0.0 && decayed > kSettled) return leg_.load_N;
  const double decay = std::exp(-decayed);
  const double root = std::sqrt(1.0 - specimen_.load_damping * specimen_.load_damping);
  const double angle = root * specimen_.load_frequency_rad_s * since_s;
  const double left = decay * (std::cos(angle) + specimen_.load_damping / root * std::sin(angle));
  const double load_N = leg_.load_N + (load_before_N_ - leg_.load_N) * left;
  return leg_.load_N > 0.0 ? load_N : std::max(0.0, load_N);  // a lifted tire does not pull
}

double Plant::recorded_speed_at(double time_s) const {
  return std::max(0.0, leg_.start_m_s + leg_.acceleration_m_s2() * (time_s - leg_.start_s));
}

double Plant::speed_at(double time_s) const {
  double speed_m_s = recorded_speed_at(time_s);
  for (const Effect& effect : effects_) speed_m_s = effect.true_speed_m_s(speed_m_s);
  return speed_m_s;
}

double Plant::moving_mass_kg(double load_N) const {
  return specimen_.machine->calc_moving_mass_kg(specimen_, load_N, leg_.load_N);
}

Instant Plant::find_instant(double time_s, const double* state) const {
  Instant now;
  now.time_s = time_s;
  now.speed_m_s = speed_at(time_s);
  now.load_N = load_at(time_s);
  now.ambient_degC = run_.air.at(time_s);
  for (std::size_t i = 0; i < wall_.layers; ++i) now.rubber_degC += state[i] / static_cast<double>(wall_.layers);
  now.liner_degC = state[wall_.layers - 1];
  now.gas_mol = state[wall_.layers + 1];
  // Ideal gas: energy U = 5/2 n R T, and p V = n R T = 2/5 U.
  const double gas_J = state[wall_.layers];
  now.gas_degC = gas_J / (kCvOverR * kGasConstant_J_per_mol_K * now.gas_mol) - kZeroCelsius_K;
  now.specimen = &specimen_;
  now.target_load_N = leg_.load_N;
  now.acceleration_m_s2 = leg_.acceleration_m_s2();
  now.curvature_factor = curvature_factor_;
  now.air_speed_m_s = now.speed_m_s;
  const double part = std::clamp((time_s - leg_.start_s) / leg_.duration_s, 0.0, 1.0);
  now.longitudinal_N = leg_.start_longitudinal_N + part * (leg_.end_longitudinal_N - leg_.start_longitudinal_N);
  now.brake_N = specimen_.machine->has_vehicle() ? vehicle_friction_N(time_s) / specimen_.tires
                                                 : std::max(0.0, -now.longitudinal_N);
  now.distance_m = leg_.start_distance_m + 0.5 * (leg_.start_m_s + now.speed_m_s) * (time_s - leg_.start_s);
  for (std::size_t i = 0; i < effects_.size(); ++i) effects_[i].enter(state + effect_state_[i], now);
  if (leg_.load_N <= 0.0) now.load_N = load_at(time_s);  // whatever a record or a strap says, a lifted tire is off
  now.pressure_kPa = 1e-3 * (gas_J / (kCvOverR * cavity_m3_ * now.volume_factor) - kStandardAtmosphere_Pa);
  return now;
}

/// Of all wheels: what the motor's recuperation leaves, by the vehicle's own numbers. Assumed: 1.2 kg/m3 of air.
double Plant::vehicle_friction_N(double time_s) const {
  const double v = recorded_speed_at(time_s);
  const double mass_kg = specimen_.truth(Base::kMass);
  const double rolling_N = 0.008 * mass_kg * kStandardGravity_m_s2;  // Assumed: enough for the driver's foot
  const double demand_N = (mass_kg + specimen_.truth(Base::kRotatingMass)) * leg_.acceleration_m_s2() +
                          mass_kg * kStandardGravity_m_s2 * leg_.slope() + rolling_N +
                          0.6 * specimen_.truth(Base::kDragArea) * v * v;
  const double limit_N = mass_kg * specimen_.regeneration_m_s2 * std::min(1.0, v / specimen_.regeneration_fade_m_s);
  return std::max(0.0, -demand_N - limit_N);
}

bool Plant::friction_brakes_at(double time_s) const {
  return specimen_.machine->has_vehicle() && vehicle_friction_N(time_s) > 0.0;
}

/// Beside the tires: slope and air, with the density of dry air.
double Plant::calc_vehicle_N(const Instant& now) const {
  const double slope = leg_.slope();
  const double grade_N = specimen_.truth(Base::kMass) * kStandardGravity_m_s2 * slope / std::sqrt(1.0 + slope * slope);
  const double density = kStandardAtmosphere_Pa / (kGasConstantOfAir_J_per_kg_K * (now.ambient_degC + kZeroCelsius_K));
  const double air_m_s = now.speed_m_s + now.wind_m_s;
  const double area_m2 = specimen_.truth(Base::kDragArea) * now.drag_factor;
  return grade_N + 0.5 * density * area_m2 * air_m_s * std::abs(air_m_s) + now.body_force_N;
}

/// Each layer loses by its own temperature; the mean of all is the rolling resistance.
void Plant::find_losses(const double* state, Instant& now, std::vector<double>& layer_loss_N) const {
  for (std::size_t i = 0; i < effects_.size(); ++i) effects_[i].act(state + effect_state_[i], now);
  if (run_.surface_degC.has_value()) now.surface_rise_dK = *run_.surface_degC - now.ambient_degC;
  const double v = now.speed_m_s;
  const double fade = v / std::sqrt(v * v + kCreep_m_s * kCreep_m_s);
  const double cold_N = specimen_.truth(Base::kA0) + specimen_.truth(Base::kA1) * v;
  const double fall_per_K = specimen_.truth(Base::kB0) + specimen_.truth(Base::kB1) * v;
  const double constant_N = follows_law_ ? 0.0 : 1e-3 * specimen_.truth(Base::kRrc) * now.load_N * now.loss_factor;
  const double level =
      curvature_factor_ * now.load_N / specimen_.reference_load_N *
      std::exp(specimen_.pressure_exponent * std::log(specimen_.reference_pressure_kPa / now.pressure_kPa)) *
      now.loss_factor * cold_N;
  layer_loss_N.resize(wall_.layers);
  for (std::size_t i = 0; i < wall_.layers; ++i) {
    const double law_N = follows_law_ ? level * std::exp(-fall_per_K * state[i]) : constant_N;
    layer_loss_N[i] = fade * loss_share_[i] * (law_N + now.heating_force_N);
    now.rolling_N += layer_loss_N[i];
  }
  const double bearing_N = specimen_.truth(Base::kC0) + specimen_.truth(Base::kC1) * v;
  now.bearing_N = fade * now.bearing_factor * bearing_N;
  now.rig_force_N = now.bearing_N + fade * (specimen_.truth(Base::kC2) * v * v + now.rig_force_N);
}

void Plant::calc_rates(double time_s, const double* state, double* rates) const {
  Instant now = find_instant(time_s, state);
  thread_local std::vector<double> loss_N;
  find_losses(state, now, loss_N);
  const std::size_t n = wall_.layers;
  const double layer_J_per_K = specimen_.truth(Base::kC) / static_cast<double>(n);
  const double between_W_per_K = wall_.conductance_W_per_K * static_cast<double>(n);
  const double air_W_per_K = 0.5 * specimen_.truth(Base::kZ) + specimen_.truth(Base::kF) * now.air_speed_m_s;
  const double surface_W_per_K = 0.5 * specimen_.truth(Base::kZ);
  for (std::size_t i = 0; i < n; ++i) rates[i] = loss_N[i] * now.speed_m_s;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double through_W = between_W_per_K * (state[i] - state[i + 1]);
    rates[i] -= through_W;
    rates[i + 1] += through_W;
  }
  const double tread_W_per_K = surface_W_per_K + wall_.tread_share_of_air * air_W_per_K;
  rates[0] -= tread_W_per_K * (state[0] - now.ambient_degC);
  rates[0] += surface_W_per_K * now.surface_rise_dK + now.tread_heat_W;
  const double to_gas_W = specimen_.truth(Base::kH) * now.gas_link_factor * (now.liner_degC - now.gas_degC);
  rates[n - 1] += now.liner_heat_W - to_gas_W -
                  (1.0 - wall_.tread_share_of_air) * air_W_per_K * (now.liner_degC - now.ambient_degC);
  for (std::size_t i = 0; i < n; ++i) rates[i] /= layer_J_per_K;
  // What leaks takes its enthalpy 7/2 R T along.
  rates[n] = to_gas_W + now.gas_heat_W -
             now.leak_mol_s * (kCvOverR + 1.0) * kGasConstant_J_per_mol_K * (now.gas_degC + kZeroCelsius_K);
  rates[n] -= 1e3 * (now.pressure_kPa + 1e-3 * kStandardAtmosphere_Pa) * cavity_m3_ *
              now.volume_rate_per_s;  // work on the wall
  rates[n + 1] = -now.leak_mol_s;
  std::fill(rates + n + 2, rates + size_, 0.0);
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    effects_[i].rates(state + effect_state_[i], now, rates + effect_state_[i]);
  }
}

Reading Plant::read(double time_s, const double* state) const {
  Instant now = find_instant(time_s, state);
  thread_local std::vector<double> loss_N;
  find_losses(state, now, loss_N);
  Reading reading{now.rig_force_N, now.liner_degC, now.pressure_kPa};
  for (const double layer_N : loss_N) reading.force_N += layer_N;
  if (specimen_.machine->has_vehicle()) reading.force_N = specimen_.tires * reading.force_N + calc_vehicle_N(now);
  return reading;
}

}  // namespace rollrig::generator
