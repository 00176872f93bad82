#pragma once
/// Forces on a vehicle beside those of its tires.

#include "models/ports.h"
#include "models/vehicle/road_load.h"
#include "sim/core/scalar.h"
#include "sim/core/units.h"

namespace rollrig::models {

constexpr double kGasConstantOfAir_J_per_kg_K = 287.05;  // dry air; International Standard Atmosphere, ISO 2533

/// Density of dry air.
/// Equation  rho = p/(R T)
/// Symbols   p absolute pressure [Pa], T temperature [K], R = 287.05 J/(kg K)
/// Source    ideal gas
/// Checked   tests/models/vehicle_test.cpp
template <class S>
S calc_air_density_kg_per_m3(const S& pressure_Pa, const S& temperature_K) {
  const S R = quantity<S>(kGasConstantOfAir_J_per_kg_K, {0, 2, -2, -1});
  return pressure_Pa / (R * temperature_K);
}

/// Aerodynamic drag, against the motion when positive.
/// Equation  F = rho/2 CdA w |w|,  w = v + wind
/// Symbols   v speed [m/s], wind along the road, positive against the vehicle [m/s], CdA drag area [m2]
/// Source    definition of the drag coefficient; the C v^2 of (3.20)
/// Checked   tests/models/vehicle_test.cpp
template <class S>
S calc_drag_N(const S& density_kg_per_m3, const S& drag_area_m2, const S& speed_m_s, const S& wind_m_s) {
  using std::abs;
  const S air_m_s = speed_m_s + wind_m_s;
  return S(0.5) * density_kg_per_m3 * drag_area_m2 * air_m_s * abs(air_m_s);
}

/// Force of gravity along a road, against the motion when positive.
/// Equation  F = m g s/sqrt(1 + s^2)
/// Symbols   s slope, rise over run [1]
template <class S>
S calc_grade_N(const S& mass_kg, const S& slope) {
  using std::sqrt;
  const S gravity_m_s2 = quantity<S>(kStandardGravity_m_s2, dimension::kAcceleration);
  return mass_kg * gravity_m_s2 * slope / sqrt(S(1.0) + slope * slope);
}

/// Road load that is gone at rest.
template <class S>
S calc_faded_road_load_N(const RoadLoad<S>& load, const S& speed_m_s) {
  return calc_standstill_fade(speed_m_s) * calc_road_load_N(load, speed_m_s);
}

/// How a demand for force is shared between motor and friction brakes.
template <class S>
struct ForceDemand {
  S motor_N{};     // of the driven axles: drives when positive, recuperates when negative
  S friction_N{};  // of all friction brakes, not negative
};

/// Blended braking: the motor brakes as far as it may, friction takes the rest.
/// Equation  F >= 0: motor F; F < 0: motor -min(-F, L min(1, v/v_f)), friction -F - |motor|
/// Symbols   F demand [N], L most that the motor brakes [N], v speed [m/s], v_f speed below which it fades [m/s]
/// Source    Assumed: usual series blending of electric cars
/// Checked   tests/models/vehicle_test.cpp
template <class S>
ForceDemand<S> blend_brakes(const S& demand_N, const S& motor_limit_N, const S& speed_m_s, const S& fade_m_s) {
  using std::abs;
  if (value_of(demand_N) >= 0.0) return {demand_N, quantity<S>(0.0, dimension::kForce)};
  const S fade = abs(speed_m_s) / fade_m_s;
  const S limit_N = value_of(fade) < 1.0 ? S(motor_limit_N * fade) : motor_limit_N;
  const S motor_N = value_of(-demand_N) < value_of(limit_N) ? S(-demand_N) : limit_N;
  return {-motor_N, -demand_N - motor_N};
}

/// Whether the vehicle is to stand still. Its motor holds it then, uphill and downhill, without power: a friction
/// brake whose force fades with the speed would let it creep.
/// Source    Assumed: hill hold, usual of electric cars
/// Checked   tests/rigs/vehicle_stops_test.cpp
template <class S>
bool is_held(const InputPort<S>& acting) {
  return value_of(acting.speed_m_s) == 0.0 && value_of(acting.acceleration_m_s2) == 0.0;
}

}  // namespace rollrig::models
