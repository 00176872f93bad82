#pragma once
/// Rolling resistance of one tire as a function of speed, temperature, pressure and load.

#include "models/tire/conversion_laws.h"
#include "models/tire/tire.h"

namespace rollrig::models {

/// A = A0 + A1 v [N] and B = B0 + B1 v [1/K] at one load and speed (3.6).
template <class S>
struct LossCoefficients {
  S A_N{};
  S B_per_K{};
};

/// Coefficients at a load.
/// Equation  without a map  A = (Fz/Fz_ref) (A0 + A1 v), B = B0 + B1 v      (3.4), (3.5)
///           with a map     A0, A1, B0, B1 linear in load between two entries (§3.3.1.3)
///           below the tire's lowest speed v_low, v stands for v_low
/// Validity  outside the map the nearest entry holds and A goes in proportion to the load, as in (3.5). Lines
///           through two high speeds need not hold down to standstill, where they may cross zero: §4.2.1 trusts
///           them from 20 km/h. v_low = 0, unless a tire says otherwise
template <class S>
LossCoefficients<S> calc_loss_coefficients(const TireParameters<S>& tire, const S& true_speed_m_s, const S& load_N) {
  const S& lowest_m_s = tire.rolling_resistance.lowest_speed_m_s;
  const S& speed_m_s = true_speed_m_s < lowest_m_s ? lowest_m_s : true_speed_m_s;
  const auto scaled = [&](const auto& c, const S& reference_load_N) {
    return LossCoefficients<S>{load_N / reference_load_N * (c.A0_N + c.A1_N_s_per_m * speed_m_s),
                               c.B0_per_K + c.B1_s_per_m_K * speed_m_s};
  };
  const auto& map = tire.load_map;
  if (map.empty()) return scaled(tire.rolling_resistance, tire.rolling_resistance.reference_load_N);
  if (load_N <= map.front().load_N) return scaled(map.front(), map.front().load_N);
  if (load_N >= map.back().load_N) return scaled(map.back(), map.back().load_N);
  std::size_t above = 1;
  while (load_N > map[above].load_N) ++above;
  const LoadMapEntry<S>& low = map[above - 1];
  const LoadMapEntry<S>& high = map[above];
  const S share = (load_N - low.load_N) / (high.load_N - low.load_N);
  const auto between = [&share](const S& a, const S& b) -> S { return a + share * (b - a); };
  return {between(low.A0_N, high.A0_N) + between(low.A1_N_s_per_m, high.A1_N_s_per_m) * speed_m_s,
          between(low.B0_per_K, high.B0_per_K) + between(low.B1_s_per_m_K, high.B1_s_per_m_K) * speed_m_s};
}

/// Rolling resistance on the reference drum.
/// Equation  F_rr = (p/p_ref)^-a A exp(-B T),  A and B from calc_loss_coefficients
/// Symbols   p gauge pressure [Pa], p_ref reference [Pa], a pressure exponent [1], T tire temperature;
///           speed v [m/s], load Fz [N]; given in K, T stands in degC in the exponential
/// Validity  p > 0. Fitted above 20 km/h (§4.2.1). Assumed: it holds from standstill up
/// Energy    F_rr v is taken from the motion and heats the rubber (3.8)
/// Source    (3.2) to (3.5); (3.5) is the same law with A divided by RRc_ISO Fz/1000
/// Checked   tests/models/rolling_resistance_test.cpp
template <class S>
S calc_rolling_resistance_N(const TireParameters<S>& tire, const S& speed_m_s, const S& load_N, const S& pressure_Pa,
                            const S& temperature_K) {
  using std::exp;
  const RollingResistanceParameters<S>& rr = tire.rolling_resistance;
  const S temperature_above_0degC_dK = temperature_K - quantity<S>(kZeroCelsius_K, dimension::kTemperature);
  const LossCoefficients<S> c = calc_loss_coefficients(tire, speed_m_s, load_N);
  return calc_pressure_factor(pressure_Pa, rr.reference_pressure_Pa, rr.pressure_exponent) * c.A_N *
         exp(-c.B_per_K * temperature_above_0degC_dK);
}

/// Factor by which rolling and bearing forces fade below walking pace, with the sign of the motion.
/// Equation  tanh(v / 0.05 m/s)
/// Source    Assumed: forces of friction reverse with the motion, within walking pace, and are smooth for a solver
template <class S>
S calc_standstill_fade(const S& speed_m_s) {
  using std::tanh;
  constexpr double kFadeSpeed_m_s = 0.05;
  return tanh(speed_m_s / quantity<S>(kFadeSpeed_m_s, dimension::kSpeed));
}

}  // namespace rollrig::models
