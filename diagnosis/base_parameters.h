#pragma once
/// The baseline's own numbers and how well they are known: what a recalibration may move, and how far.

#include <vector>

#include "identification/parameters.h"
#include "scenarios/measurement_set.h"

namespace rollrig::diagnosis {

/// A0, A1, B0, B1, heat capacities, H, z, f of the tire and c0, c1, c2 of the rig, each normal around the file's value
/// with the file's standard uncertainty. Where the file gives none, a default:
/// A0, A1 2 % of the loss at 80 km/h; B0, B1 4 %; heat capacities 5 % (rubber) and 10 % (gas); H 15 %;
/// z and f 8 %; c0, c1, c2 5 % of their value and 1 % of the parasitic force at 80 km/h.
/// Further numbers of [rolling_resistance] and [thermal] move only where the file gives an uncertainty.
/// Source  Assumed: the defaults, from the spread between calibrations of one tire (docs/published.md)
/// Checked tests/diagnosis/base_parameters_test.cpp
std::vector<identification::FreeParameter> find_base_parameters(const scenarios::MeasurementSet& set,
                                                                const models::Context<double>& context);

}  // namespace rollrig::diagnosis
