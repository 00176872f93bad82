#pragma once
/// What a tire fit varies, and from where it starts.

#include <optional>
#include <set>
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
  std::set<std::string> of_class{};       // keys of nuisances whose prior is that of the class, since no file gives one
};

/// Asked for, without a prior: the numbers of the law (by models::FitRole, or A0 and B0, at each load with `load_map`),
/// z, H with `free_H`; with several speeds also A1, B1 and f. Nuisances: all other numbers to which the files give an
/// uncertainty, with the correlations of the tire file, and numbers of the tire without one that have a class prior
/// (class_priors.h).
FitUnknowns choose_unknowns(const measurements::MeasurementSet& set, const std::optional<TwoStepEstimate>& start,
                            bool load_map, bool free_H);

/// Where the search for the optimum begins [SI], one value for each parameter: at its starting value. But a heat
/// capacity with a class prior begins within a factor of two of the usual one: from a guess far below, the simulated
/// tire warms up in seconds, and the search finds no way out.
std::vector<double> list_first_values(const FitUnknowns& unknowns);

/// What the tire's law finds wrong with its own numbers at these values.
std::optional<models::TireModelMistake> find_law_mistake(const FitUnknowns& unknowns, const std::vector<double>& found);

/// After an optimum with such a mistake: holds at its usual value what is free within the law only, and says so. Throws
/// RunFailure where nothing is left to hold.
std::string go_back_within_law(FitUnknowns& unknowns, const models::TireModelMistake& mistake);

}  // namespace rollrig::estimation
