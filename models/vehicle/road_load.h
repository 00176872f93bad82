#pragma once
/// Road load of a vehicle: what of the vehicle enters it, and the parabola over speed that test records publish.

#include "sim/core/scalar.h"
#include "sim/core/schema.h"

namespace rollrig::models {

/// What every use of a vehicle needs (formats.md).
template <class S>
struct VehicleBody {
  S mass_kg{};
  S rotating_mass_kg{};
  S drag_area_m2{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"mass_kg", between(100.0, 1e6), "Mass as tested"}, p.mass_kg);
    visit(Field{"rotating_mass_kg", non_negative(), "Equivalent mass of all that turns, wheels included"},
          p.rotating_mass_kg);
    visit(Field{"drag_area_m2", non_negative(), "Drag coefficient times frontal area; not needed beside [road_load]"},
          p.drag_area_m2);
  }
};

/// A, B, C of a vehicle on a level road in still air. Files carry B and C per km/h, the program per m/s.
template <class S>
struct RoadLoad {
  S A_N{};
  S B_N_s_per_m{};
  S C_N_s2_per_m2{};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"A_N", any_number(), "Road load at standstill"}, p.A_N);
    visit(Field{"B_N_per_km_h", any_number(), "Its rise with speed; of either sign in public records"}, p.B_N_s_per_m);
    visit(Field{"C_N_per_km_h2", any_number(), "Its rise with the square of speed"}, p.C_N_s2_per_m2);
  }
};

/// Force that slows the vehicle down.
/// Equation  F = A + B v + C v^2
/// Symbols   v speed [m/s], not negative; A [N], B [N s/m], C [N s2/m2]
/// Validity  the speeds of the coastdown that A, B, C were fitted to; level road, no wind
/// Source    SAE J2263, scope (three-term road load); 40 CFR 1066.210(d)(1)
/// Checked   tests/models/road_load_test.cpp
template <class S>
S calc_road_load_N(const RoadLoad<S>& load, const S& speed_m_s) {
  return load.A_N + (load.B_N_s_per_m + load.C_N_s2_per_m2 * speed_m_s) * speed_m_s;
}

}  // namespace rollrig::models
