#pragma once
/// Correction of rolling resistance from one drum to another.

#include "models/ports.h"

namespace rollrig::models {

/// K_r from drum 1 to drum 2: F_r2 = K_r F_r1.
/// Equation  K_r = sqrt((R_1/R_2) (R_2 + r_T) / (R_1 + r_T)), written with curvatures k = 1/R so that a
///           flat surface (k = 0) is a drum like any other: sqrt((1 + r_T k_2) / (1 + r_T k_1))
/// Symbols   k_1, k_2 curvature of drum 1 and 2 [1/m]; r_T half the nominal tire diameter [m]
/// Validity  k >= 0
/// Source    (3.1)
/// Checked   tests/models/small_laws_test.cpp
template <class S>
S calc_drum_correction(const S& curvature_1_per_m, const S& curvature_2_per_m, const S& tire_radius_m) {
  using std::sqrt;
  return sqrt((S(1.0) + tire_radius_m * curvature_2_per_m) / (S(1.0) + tire_radius_m * curvature_1_per_m));
}

/// K, the correction from the drum on which A0 and A1 hold to the surface of this context.
template <class S>
S calc_curvature_factor(const Context<S>& context) {
  const S reference_per_m = S(2.0) / context.tire.rolling_resistance.reference_drum_diameter_m;
  const S tire_radius_m = context.tire.geometry.outer_diameter_m / S(2.0);
  return calc_drum_correction(reference_per_m, context.surface_curvature_per_m, tire_radius_m);
}

}  // namespace rollrig::models
