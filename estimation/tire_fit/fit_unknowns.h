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

/// Asked for, without a prior: the numbers of the law (by models::FitRole, or A0, A1, B0 and B1, at each load with
/// `load_map`); z; f, of another law than the source's with several speeds only; H with `free_H`. Nuisances: all other
/// numbers to which the files give an uncertainty, with the correlations of the tire file.
FitUnknowns choose_unknowns(const measurements::MeasurementSet& set, const std::optional<TwoStepEstimate>& start,
                            bool load_map, bool free_H);

/// What the tire's law finds wrong with its own numbers at these values.
std::optional<models::TireModelMistake> find_law_mistake(const FitUnknowns& unknowns, const std::vector<double>& found);

/// After an optimum with such a mistake: holds at its usual value what is free within the law only, and says so. Throws
/// RunFailure where nothing is left to hold.
std::string go_back_within_law(FitUnknowns& unknowns, const models::TireModelMistake& mistake);

}  // namespace rollrig::estimation
