#pragma once
/// The baseline's own numbers and how well they are known: what a recalibration may move, and how far.

#include <map>
#include <string>
#include <vector>

#include "estimation/normal_prior.h"
#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// Standard uncertainties in SI units, by key: those that the files give, and defaults for where they give none.
struct Uncertainties {
  std::map<std::string, double> given;
  std::map<std::string, double> usual;
  std::vector<models::CorrelatedPair> correlated{};  // among those given
};

/// Groups of numbers that a kind of set moves (kinds/measurement_kind.h).
/// What the tire's model uses. A0, A1: 2 % of the loss at 80 km/h; B0, B1: 4 %; the constant coefficient: 5 %. Where
/// the tire's heat shows in what is measured, heat capacities: 5 % (rubber) and 10 % (gas); H: 15 %; conductances to
/// air and road: 8 %. The model's own numbers: the share that it declares. Further numbers where the file gives an
/// uncertainty.
void add_tire(const models::TireFile& tire, const models::CoolingRig& rig, const models::Context<double>& context,
              bool heat_is_seen, Uncertainties& uncertainties);
/// c0, c1, c2: 5 % of their value and 1 % of the parasitic force at 80 km/h.
void add_parasitic_loss(const rigs::RigFile& file, Uncertainties& uncertainties);
/// Mass: 3 %; rotating mass: 30 %; drag area: 5 %.
void add_vehicle(const rigs::VehicleFile& file, Uncertainties& uncertainties);

/// What the set's kind moves, each normal around the file's value with the file's standard uncertainty or, where the
/// file gives none, the default; jointly normal where the tire's file gives correlations.
/// Source  Assumed: the defaults, from the spread between calibrations of one tire (docs/published.md)
/// Checked tests/diagnosis/base_parameters_test.cpp
std::vector<estimation::FreeParameter> find_base_parameters(const measurements::MeasurementSet& set,
                                                            const models::Context<double>& context);

}  // namespace rollrig::diagnosis
