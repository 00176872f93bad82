#pragma once
/// A measured loss converted to other conditions, factor by factor. Equations and validity: docs/convert.md.

#include <optional>
#include <string>
#include <vector>

#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// A loss as force, as RRc, or as both where the load is known.
struct Loss {
  std::optional<double> force_N, rrc_N_per_kN;
};

/// Where a loss was measured, or is wanted. What is absent is the same on both sides.
struct LossConditions {
  std::optional<double> drum_curvature_per_m;  // 1/R; 0 for the flat road
  std::optional<double> tire_diameter_m;       // outer
  std::optional<double> pressure_Pa;           // gauge
  std::optional<double> ambient_K;
  std::optional<double> load_N;
};

/// What is to be converted. Errors name a member as the option of the command line: from.load_N as "--load".
struct ConversionInput {
  Loss loss;  // one of the two
  LossConditions from, to;
  std::string tire;  // name of an asset, or a path: its diameter and pressure exponent, where they are absent here
  std::optional<double> pressure_exponent;          // a of (p/p_ref)^-a; absent: that of the tire, else 0.4
  std::optional<double> load_exponent;              // of the force; absent: 1 as in (3.5), RRc independent of load
  std::optional<double> diameter_exponent;          // n of D^-n; absent: 1/3 as in (2.1)
  std::optional<double> ambient_coefficient_per_K;  // K_t of ISO 28580; absent: 0.008, of class C1
};

/// One factor of a conversion, its conditions as text with their unit.
struct ConversionFactor {
  std::string name, equation, from, to;
  double factor = 1.0;
};

/// All factors between two conditions.
struct ConversionFactors {
  std::vector<ConversionFactor> factors;
  double force_factor = 1.0;  // the product, on a force
  std::vector<std::string> warnings;
};

/// A converted loss; as a report without page and files.
struct ConvertedLoss : ConversionFactors, Report {
  Loss given, result;
};

/// Converts a loss. If the load of the measurement is known, `given` and `result` have both force and RRc.
/// Example  convert_loss({{32.0, {}}, {1.0, 0.7}, {0.0}}).result.force_N: from a drum of radius 1 m to the flat road
/// Errors   InputError: not one loss; a value out of its range; a drum, pressure or temperature on one side alone; a
///          load or tire diameter in `to` alone; a drum without a tire diameter; an exponent or
///          coefficient without the conditions it applies to; air so cold that K_t gives no positive loss; an unknown
///          tire
ConvertedLoss convert_loss(const ConversionInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
