#pragma once
/// The simulated test of ISO 28580 of a tire, and its RRc held against the one that the tire's file states.

#include <optional>
#include <string>

#include "models/tire/tire_file.h"

namespace rollrig::scenarios {

/// Warm-up that ISO 28580 asks for: 30 min of class C1, 50 min of tires marked C, 150 min of heavier ones, and 180 min
/// of those on rims from 22.5 inches.
/// Source    Assumed: ISO 28580, table of warm-up times, as other publications cite it; a tire is heavy if its load in
///           the test is more than 85 % of the load of index 121
double find_iso_warm_up_s(const models::TireFile& tire);

/// RRc at 25 degC on the 2 m drum [N/N]: the scenario iso_28580 after the warm-up of the tire's class, quasi-static.
/// Errors    InputError: the tire lacks a table that the test needs; RunFailure
double simulate_iso_rrc(const models::TireFile& tire);

/// Scales bounded.loss_N so that the test gives the RRc of [iso_28580].
/// Errors    RunFailure: no loss does
/// Checked   tests/scenarios/scaffold_test.cpp
void scale_to_iso_rrc(models::TireFile& tire);

/// How far the simulated RRc may be from the stated one, relative to that, before check_iso_rrc() warns. Assumed: about
/// the standard deviation that ISO 28580 allows a laboratory, 0.075 N/kN of 8 N/kN.
constexpr double kIsoTolerance = 0.01;

/// A warning where the simulated RRc is further from the one of the file than kIsoTolerance; none of a tire without
/// [iso_28580].
std::optional<std::string> check_iso_rrc(const models::TireFile& tire);

}  // namespace rollrig::scenarios
