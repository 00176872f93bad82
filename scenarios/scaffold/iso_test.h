#pragma once
/// The simulated test of ISO 28580 of a tire, and its RRc held against the one that the tire's file states.

#include <optional>
#include <string>
#include <vector>

#include "models/tire/tire_file.h"

namespace rollrig::scenarios {

/// RRc at 25 degC on the 2 m drum [N/N]: the scenario iso_28580 as the tire's file has its conditions, quasi-static.
/// Errors    InputError: the tire lacks a table that the test needs; RunFailure
double simulate_iso_rrc(const models::TireFile& tire);

/// The same test where its RRc is to be stated, as for a label.
struct StatedIsoTest {
  double rrc = 0.0;                   // as above
  std::vector<std::string> warnings;  // of the run
};

/// Errors    as above; InputError where the test of the file is not that of the standard for the class of the tire, so
///           that the scenario iso_28580 gives no label class
StatedIsoTest simulate_stated_iso_test(const models::TireFile& tire);

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
