#pragma once
/// Factors of rolling resistance between tire diameters, pressures and temperatures of the air.

#include "sim/core/scalar.h"
#include "sim/core/units.h"

namespace rollrig::models {

constexpr double kDiameterExponent = 1.0 / 3.0;  // (2.1)
constexpr double kOtherDiameterExponent = 0.62;  // of -4.8 % for +8.3 %: Redrouthu and Das, Chalmers 2014

/// Factor from a tire of diameter D_1 to one of D_2, everything else being similar: F_r2 = factor F_r1.
/// Equation  F_r ~ D^-n, so the factor is (D_1/D_2)^n
/// Symbols   D_1, D_2 outer diameters [m]; n exponent, 1/3 in (2.1)
/// Validity  D > 0; tires of one construction
/// Source    (2.1)
/// Checked   tests/models/conversion_laws_test.cpp
template <class S>
S calc_tire_diameter_factor(const S& diameter_1_m, const S& diameter_2_m, const S& exponent) {
  using std::pow;
  return pow(diameter_1_m / diameter_2_m, exponent);
}

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

constexpr double kAmbientCoefficient_per_K = 0.008;                  // K_t of ISO 28580 for class C1
constexpr double kReferenceAmbient_K = kZeroCelsius_K + 25.0;        // ISO 28580
constexpr double kLowestCorrectedAmbient_K = kZeroCelsius_K + 20.0;  // ISO 28580: allowed for a test
constexpr double kHighestCorrectedAmbient_K = kZeroCelsius_K + 30.0;

/// Factor from a loss measured in air of T_amb to that in air of 25 degC.
/// Equation  1 + K_t (T_amb - 25 degC)
/// Symbols   K_t [1/K], 0.008 for class C1, 0.010 for C2 and for C3 of load index 121 or less, 0.006 for C3 with a
///           higher load index; T_amb temperature of the air [K]
/// Validity  20 to 30 degC (is_ambient_correction_valid); positive above 25 degC - 1/K_t, for C1 -100 degC
/// Source    ISO 28580 as in §3.2.3.3, K_t from the standard and from UN Regulation No. 117, Annex 6
/// Checked   tests/models/conversion_laws_test.cpp
template <class S>
S calc_ambient_correction(const S& ambient_K, const S& coefficient_per_K = S(kAmbientCoefficient_per_K)) {
  return S(1.0) + coefficient_per_K * (ambient_K - S(kReferenceAmbient_K));
}

/// Whether the standard allows its correction at this temperature.
inline bool is_ambient_correction_valid(double ambient_K) {
  return ambient_K >= kLowestCorrectedAmbient_K - 1e-9 && ambient_K <= kHighestCorrectedAmbient_K + 1e-9;
}

}  // namespace rollrig::models
