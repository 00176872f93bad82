#pragma once
/// The baseline's own numbers and how well they are known: what a recalibration may move, and how far.

#include <map>
#include <string>
#include <vector>

#include "estimation/normal_prior.h"
#include "include/rollrig/findings.h"
#include "measurements/measurement_set.h"

namespace rollrig::diagnosis {

/// Standard uncertainties in SI units, by key: those that the files give, and those that are assumed where they give
/// none.
struct Uncertainties {
  std::map<std::string, double> given;
  std::map<std::string, double> usual;     // of numbers that were identified
  std::map<std::string, double> of_class;  // of numbers that are, or may be, values of the tire's class or guesses
  std::vector<models::CorrelatedPair> correlated{};  // among those given
  bool is_origin_open = false;  // whether `of_class` is a belief of its own beside `usual`: the file does not say
};

/// Standard uncertainties of a tire's numbers as shares of what they change at 80 km/h.
///
/// A model's own numbers are shares of the file's value, as all others: a diagnosis asks how far what the file says may
/// move. A fit replaces the number, which is a guess there, and takes a share of the usual value. Here the share of a
/// tire of the class is three times that of an identified one, so a guess down to a third of what is true still counts
/// as no better known than an identified number; one that is guessed lower counts as known too well.
struct TireShares {
  double loss;               // A0, A1, of A0 + A1 v
  double fall;               // B0, B1, of B0 + B1 v
  double heat_capacity;      // of the rubber
  double gas_heat_capacity;  //
  double gas_transfer;       // H
  double conductance;        // z, f: of the value, and at least of a tenth of z + f v
  double coefficient;        // the constant coefficient
  double own;                // a model's own numbers, in shares that the model declares (TireModelParameter::usual_sd)
};
/// Source  Assumed: from the spread between calibrations of one tire (docs/published.md)
constexpr TireShares kIdentifiedTire{0.02, 0.04, 0.05, 0.10, 0.15, 0.08, 0.05, 1.0};
/// Source  Assumed: a label class of RRc is 7 to 15 % wide; slopes over temperature and heat balances of passenger-car
///         tires differ by a quarter
constexpr TireShares kClassTire{0.10, 0.25, 0.20, 0.20, 0.30, 0.25, 0.15, 3.0};

/// Groups of numbers that a kind of set moves (kinds/measurement_kind.h).
/// What the tire's model uses, by kIdentifiedTire; the heat balance where the tire's heat shows in what is measured.
/// Numbers without an uncertainty are by kClassTire where the file says that they are of the class, and may be where it
/// does not say: neither by `basis`, nor by an uncertainty of any other number of the loss, or of the heat balance.
/// Further numbers where the file gives an uncertainty.
void add_tire(const models::TireFile& tire, const models::CoolingRig& rig, const models::Context<double>& context,
              bool heat_is_seen, Uncertainties& uncertainties);
/// c0, c1, c2: 5 % of their value and 1 % of the parasitic force at 80 km/h.
void add_parasitic_loss(const rigs::RigFile& file, Uncertainties& uncertainties);
/// Mass: 3 %; rotating mass: 30 %; drag area: 5 %.
void add_vehicle(const rigs::VehicleFile& file, Uncertainties& uncertainties);

/// Which assumed uncertainties hold for numbers of a tire whose origin the file leaves open.
enum class TireBelief { kIdentified, kClass };

/// What the set's kind moves, each normal around the file's value with the file's standard uncertainty or, where the
/// file gives none, the default; jointly normal where the tire's file gives correlations.
/// Source  Assumed: the defaults, from the spread between calibrations of one tire (docs/published.md)
/// Checked tests/diagnosis/base_parameters_test.cpp
std::vector<estimation::FreeParameter> find_base_parameters(const measurements::MeasurementSet& set,
                                                            const models::Context<double>& context,
                                                            TireBelief belief = TireBelief::kIdentified);

/// Where the standard uncertainty of each of them comes from.
std::map<std::string, rollrig::SdSource> find_sd_sources(const measurements::MeasurementSet& set,
                                                         const models::Context<double>& context, TireBelief belief);

/// Whether the tire's file leaves open how well some of its numbers are known.
bool is_tire_origin_open(const measurements::MeasurementSet& set);

}  // namespace rollrig::diagnosis
