#pragma once
/// A measured loss carried from one set of conditions to another, factor by factor (`rollrig convert`).

#include "include/rollrig/convert.h"
#include "models/tire/conversion_laws.h"

namespace rollrig::estimation {

/// Every factor between two conditions, of a force. A condition given on one side alone is not converted.
/// Equation  (3.1) for drums, (2.1) for the tire's diameter, (p_2/p_1)^-a of (3.4),
///           (1 + K_t (T_1 - 25 degC))/(1 + K_t (T_2 - 25 degC)), (F_z2/F_z1)^n
///           A tire of another diameter goes from drum 1 to the flat road, changes there, and goes to drum 2:
///           r_T in (3.1) is each tire's own, and only so is the way back the inverse.
/// Validity  that of each factor; warned of outside the standard's 20 to 30 degC and outside a = 0.3 to 0.5
/// Source    the equations named; ISO 28580 for the air
/// Errors    InputError: a drum without a tire diameter, air so cold that the correction has no sense
/// Checked   tests/estimation/loss_conversion_test.cpp
ConversionFactors convert_loss(const LossConditions& from, const LossConditions& to,
                               double pressure_exponent = models::kPressureExponent, double load_exponent = 1.0);

}  // namespace rollrig::estimation
