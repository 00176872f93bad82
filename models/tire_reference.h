#pragma once
/// Effects that need the reference load or the reference pressure of the tire's loss.

#include <string>
#include <vector>

#include "models/effect.h"

namespace rollrig::models {

/// Whether the effect's equations have reference_load_N or reference_pressure_kPa of the tire's [rolling_resistance].
bool uses_tire_reference(const Effect& effect);

/// Throws InputError for an effect that acts there and uses them, where the tire has no [rolling_resistance]: it would
/// divide by zero. `tire_path` stands in the message.
void require_tire_reference(const Context<double>& context, const std::vector<ActiveEffect>& effects,
                            const std::string& tire_path);

}  // namespace rollrig::models
