#pragma once
/// Loss of the rig alone.

#include "models/tire/rolling_resistance.h"
#include "sim/core/schema.h"

namespace rollrig::models {

/// Coefficients of the parasitic loss, as force at the surface of the drum, tire lifted. Assumed: the upper limits, far
/// above any machine; beyond them, the rolling resistance is lost in the rounding of the drum torque.
template <class S>
struct ParasiticParameters {
  S c0_N{};
  S c1_N_s_per_m{};
  S c2_N_s2_per_m2{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"c0_N", between(0.0, 1e5), "Bearing friction"}, p.c0_N);
    visit(Field{"c1_N_s_per_m", between(0.0, 1e4), "Its rise with speed"}, p.c1_N_s_per_m);
    visit(Field{"c2_N_s2_per_m2", between(0.0, 1e3), "Air drag of the drum"}, p.c2_N_s2_per_m2);
  }
};

/// Parasitic loss as a force at the surface.
/// Equation  F_par = c0 + c1 v + c2 v^2
/// Symbols   v surface speed [m/s], not negative
/// Source    definition of parasitic loss: §3.2.1 item 5. Assumed: the quadratic form
/// Checked   tests/models/small_laws_test.cpp
template <class S>
S calc_parasitic_N(const ParasiticParameters<S>& p, const S& speed_m_s) {
  return p.c0_N + p.c1_N_s_per_m * speed_m_s + p.c2_N_s2_per_m2 * speed_m_s * speed_m_s;
}

/// The same at a speed of either sign, against the motion, gone at rest.
template <class S>
S calc_faded_parasitic_N(const ParasiticParameters<S>& p, const S& speed_m_s) {
  using std::abs;
  return calc_standstill_fade(speed_m_s) * calc_parasitic_N(p, S(abs(speed_m_s)));
}

}  // namespace rollrig::models
