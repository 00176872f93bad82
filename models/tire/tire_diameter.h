#pragma once
/// Rolling resistance against the outer diameter of the tire.

#include "sim/core/scalar.h"

namespace rollrig::models {

/// Factor from a tire of diameter D_1 to one of D_2, everything else being similar: F_r2 = factor F_r1.
/// Equation  F_r ~ D^(-1/3), so the factor is (D_1/D_2)^(1/3)
/// Symbols   D_1, D_2 outer diameters [m]
/// Validity  D > 0; tires of one construction
/// Source    (2.1)
/// Checked   tests/models/conversion_laws_test.cpp
template <class S>
S calc_tire_diameter_factor(const S& diameter_1_m, const S& diameter_2_m) {
  using std::pow;
  return pow(diameter_1_m / diameter_2_m, S(1.0 / 3.0));
}

}  // namespace rollrig::models
