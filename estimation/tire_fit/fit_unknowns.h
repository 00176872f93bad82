#pragma once
/// What a tire fit varies, and from where it starts.

#include <optional>
#include <string>
#include <vector>

#include "estimation/normal_prior.h"
#include "estimation/tire_fit/two_step.h"
#include "measurements/measurement_set.h"
#include "models/tire/tire_model.h"

namespace rollrig::estimation {

/// The numbers that a fit varies.
struct FitUnknowns {
  models::Context<double> start;          // the files' numbers, with the two-step estimate put in where there is one
  std::vector<FreeParameter> parameters;  // keys, starting values, bounds and priors
  std::size_t asked_for = 0;              // the first so many; the others are nuisances
};

/// The numbers of the tire's law: A0, A1, B0 and B1, at each load of the set with `load_map`, or those of another law
/// by their role (models::FitRole); the conductances of the set's rig, of another law at several speeds only (else that
/// at rest alone); the conductance to the gas with `free_H`; and, as nuisances, whatever else the files give with an
/// uncertainty, correlated as the tire's file says. What is asked for has no prior.
FitUnknowns choose_unknowns(const measurements::MeasurementSet& set, const std::optional<TwoStepEstimate>& start,
                            bool load_map, bool free_H);

/// What the tire's law finds wrong with its own numbers at these values.
std::optional<models::TireModelMistake> find_law_mistake(const FitUnknowns& unknowns, const std::vector<double>& found);

/// After an optimum with such a mistake: holds at its usual value what is free within the law only, and says so. Throws
/// RunFailure where nothing is left to hold.
std::string go_back_within_law(FitUnknowns& unknowns, const models::TireModelMistake& mistake);

}  // namespace rollrig::estimation
