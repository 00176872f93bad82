#pragma once
/// A measured loss carried from one set of conditions to another, factor by factor (`rollrig convert`).

#include "include/rollrig/convert.h"
#include "models/tire/conversion_laws.h"

namespace rollrig::estimation {

/// The numbers of the conversion laws.
struct ConversionLaws {
  double pressure_exponent = models::kPressureExponent;                  // a
  double load_exponent = 1.0;                                            // b, of the force
  double diameter_exponent = models::kDiameterExponent;                  // n
  double ambient_coefficient_per_K = models::kAmbientCoefficient_per_K;  // K_t
};

/// Every factor between two conditions, of a force. A condition given on one side alone is not converted.
/// Equation  (3.1) for drums, (D_1/D_2)^n of (2.1) for the tire's diameter, (p_2/p_1)^-a of (3.4),
///           (1 + K_t (T_1 - 25 degC))/(1 + K_t (T_2 - 25 degC)), (F_z2/F_z1)^b
///           A tire of another diameter goes from drum 1 to the flat road, changes there, and goes to drum 2:
///           r_T in (3.1) is each tire's own, and only so is the way back the inverse.
/// Validity  that of each factor; a warning for air outside the standard's 20 to 30 degC, for a outside 0.3 to 0.5, and
///           for a change of the tire diameter by the usual exponent
/// Source    the equations named; ISO 28580 for the air
/// Errors    InputError: a drum without a tire diameter, air so cold that the correction has no sense
/// Checked   tests/estimation/loss_conversion_test.cpp
ConversionFactors convert_loss(const LossConditions& from, const LossConditions& to, const ConversionLaws& laws = {});

}  // namespace rollrig::estimation
