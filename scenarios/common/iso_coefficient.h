#pragma once
/// The coefficient of an ISO test as a true loss.

#include <optional>

#include "models/tire/tire_file.h"

namespace rollrig::scenarios {

/// What the tire lost in its ISO test over its load, of the coefficient in its [iso_28580]; nothing without that table.
/// The skim test, whose force the ISO test subtracts, has the tire's own loss at skim load in it. The reported
/// coefficient lacks this share; an energy that is compared with a tire's loss must have it.
/// Equation  c_true = c / (1 - F(F_skim) / F(F_z))
/// Symbols   c reported coefficient [N/N]; F loss of the tire by its law [N]; F_skim 200 N; F_z load of the ISO test
/// Validity  the tire has the same temperature in both; it cools in the skim test, which raises its share a little
/// Source    ISO 28580, skim test reading; F_skim: Kolekar and Narasimhan (2024) §3.2.1 item 6
std::optional<double> calc_true_iso_rrc(const models::TireFile& tire, models::Baseline baseline);

}  // namespace rollrig::scenarios
