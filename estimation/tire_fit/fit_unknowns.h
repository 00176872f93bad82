#pragma once
/// What a tire fit varies, and from where it starts.

#include <vector>

#include "estimation/parameters.h"
#include "estimation/tire_fit/two_step.h"
#include "measurements/measurement_set.h"

namespace rollrig::estimation {

/// The numbers that a fit varies.
struct FitUnknowns {
  models::Context<double> start;          // the files' numbers, with the two-step estimate put in
  std::vector<FreeParameter> parameters;  // keys, starting values, bounds and priors
  std::size_t asked_for = 0;              // the first so many; the others are nuisances
};

/// A0, A1, B0 and B1, at each load of the set with `load_map`; the conductances of the set's rig; the conductance to
/// the gas with `free_H`; and, as nuisances, whatever else the files give with an uncertainty.
FitUnknowns choose_unknowns(const measurements::MeasurementSet& set, const TwoStepEstimate& start, bool load_map,
                            bool free_H);

}  // namespace rollrig::estimation
