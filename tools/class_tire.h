#pragma once
/// Virtual tests with a tire of which only the class is known: a50's law, its loss scaled.

#include <string>
#include <vector>

#include "scenarios/run/scenario.h"

namespace rollrig::tools {

/// A quasi-static run of a scenario with tire a50; `settings` as of --set.
scenarios::RunSpec make_virtual_test(const std::string& scenario, const char* rig,
                                     const std::vector<std::string>& settings);

/// Factor on a50's loss that gives a coefficient in the ISO test, where a tire with more loss runs warmer.
double find_loss_factor(double rrc_N_per_kN);

void scale_loss(models::TireFile& tire, double factor);

}  // namespace rollrig::tools
