#pragma once
/// The coefficient of an ISO test as a true loss.

#include <optional>

#include "models/tire/tire_file.h"

namespace rollrig::scenarios {

/// True rolling-resistance coefficient [N/N] of the tire's ISO test: the coefficient of [iso_28580], with the loss
/// added again that the skim test subtracted. Empty without [iso_28580], or where the tire lacks [rolling_resistance]
/// and its law needs it.
/// Equation  c_true = c / (1 - F(F_skim) / F(F_z))
/// Symbols   c reported coefficient [N/N]; F loss of the tire by its law [N]; F_skim 200 N; F_z load of the test [N]
/// Validity  the tire has the same temperature and pressure in both. It cools in the skim test, which raises its share
///           of the loss a little
/// Source    ISO 28580, skim test reading; F_skim: Kolekar and Narasimhan (2024) §3.2.1 item 6
/// Checked   tests/scenarios/iso_28580_test.cpp
std::optional<double> calc_true_iso_rrc(const models::TireFile& tire, models::Baseline baseline);

}  // namespace rollrig::scenarios
