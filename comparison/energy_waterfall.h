#pragma once
/// What changes the energy of one run to that of another.

#include <optional>

#include "include/rollrig/compare.h"
#include "sim/core/json.h"

namespace rollrig::comparison {

/// From the energy that the reference takes in to that of the other, by the terms of the mechanical ledger of their
/// audits, `energy.terms_J` of result.json. None where the reference takes in nothing.
/// Equation  E_B - E_A = sum_i [-(B_i - A_i)] + r;  E = in, sum over all terms = r_A, r_B
/// Symbols   in the largest positive term of the reference (the motor's, or in a coastdown the kinetic energy); A_i, B_i
///           the other terms, positive what brings energy in; r what the ledgers do not close by ("not closed")
/// Checked   tests/comparison/energy_waterfall_test.cpp
std::optional<EnergyWaterfall> make_waterfall(const Json& reference_terms_J, const Json& other_terms_J,
                                              const std::string& compared);

}  // namespace rollrig::comparison
