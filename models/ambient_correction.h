#pragma once
/// Correction of rolling resistance to the reference temperature of the air.

#include "sim/core/scalar.h"
#include "sim/core/units.h"

namespace rollrig::models {

constexpr double kAmbientCoefficient_per_K = 0.008;                  // K_t of ISO 28580 for car tires
constexpr double kReferenceAmbient_K = kZeroCelsius_K + 25.0;        // ISO 28580
constexpr double kLowestCorrectedAmbient_K = kZeroCelsius_K + 20.0;  // ISO 28580: allowed for a test
constexpr double kHighestCorrectedAmbient_K = kZeroCelsius_K + 30.0;

/// Factor from a loss measured in air of T_amb to that in air of 25 degC.
/// Equation  1 + K_t (T_amb - 25 degC)
/// Symbols   K_t 0.008 1/degC; T_amb temperature of the air [K]
/// Validity  car tires, 20 to 30 degC (is_ambient_correction_valid); zero or less below -100 degC
/// Source    ISO 28580 as in §3.2.3.3, K_t from the standard
/// Checked   tests/models/conversion_laws_test.cpp
template <class S>
S calc_ambient_correction(const S& ambient_K) {
  return S(1.0) + S(kAmbientCoefficient_per_K) * (ambient_K - S(kReferenceAmbient_K));
}

/// Whether the standard allows its correction at this temperature.
inline bool is_ambient_correction_valid(double ambient_K) {
  return ambient_K >= kLowestCorrectedAmbient_K - 1e-9 && ambient_K <= kHighestCorrectedAmbient_K + 1e-9;
}

}  // namespace rollrig::models
