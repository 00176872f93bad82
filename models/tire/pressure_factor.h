#pragma once
/// Rolling resistance against inflation pressure.

#include "sim/core/scalar.h"

namespace rollrig::models {

constexpr double kPressureExponent = 0.4;  // (3.4)

/// F_r over F_r at the reference pressure, at equal tire temperature.
/// Equation  (p/p_ref)^-a
/// Symbols   p, p_ref gauge pressures [Pa]; a exponent, 0.4 in (3.4)
/// Validity  p > 0; a 0.3 to 0.5 by the tests that §2.2.2.3 quotes
/// Source    (3.4)
/// Checked   tests/models/conversion_laws_test.cpp
template <class S>
S calc_pressure_factor(const S& pressure_Pa, const S& reference_pressure_Pa, const S& exponent) {
  using std::pow;
  return pow(pressure_Pa / reference_pressure_Pa, -exponent);
}

}  // namespace rollrig::models
