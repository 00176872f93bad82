#pragma once
/// Virtual tests with a tire of which only the class is known: a50's law, its loss scaled.

#include "models/tire/tire_file.h"

namespace rollrig::tools {

/// Factor on a50's loss that gives a coefficient in the ISO test, where a tire with more loss runs warmer.
double find_loss_factor(double rrc_N_per_kN);

void scale_loss(models::TireFile& tire, double factor);

}  // namespace rollrig::tools
