#pragma once
/// [correlation] of a tire file: how the errors of its calibrated numbers go together.

#include <string>
#include <vector>

#include "sim/core/schema.h"

namespace rollrig::models {

struct TireFile;

/// Correlations of numbers that have a standard uncertainty. Numbers that are not listed are independent of all others.
/// Equation  cov(x_i, x_j) = R_ij s_i s_j
/// Symbols   x numbers as the file has them, not their logarithms; s their standard uncertainties (`<key>_sd`);
///           R the matrix
struct TireCorrelation {
  std::vector<std::string> numbers;  // dotted keys of the file: "thermal.heat_capacity_J_per_K", "load_map.0.A0_N"
  std::vector<std::vector<double>> matrix;
};

/// Two numbers of a tire whose errors go together, each by the key of estimation::FreeParameter.
struct CorrelatedPair {
  std::string first;
  std::string second;
  double correlation = 0.0;
};

/// Reads [correlation] of a tire whose numbers and uncertainties have been read; empty where it is absent.
/// Errors  InputError: a number that the tire does not have or that has no standard uncertainty; a matrix that is not a
///         correlation matrix
/// Checked tests/models/tire_correlation_test.cpp
TireCorrelation read_correlation(TableReader& file, const TireFile& tire);

/// What holds on a rig: a conductance of [thermal.rig.<name>] stands there for that of [thermal].
std::vector<CorrelatedPair> list_correlated_pairs(const TireFile& tire, const std::string& rig);

/// The correlation of `before` without the numbers whose standard uncertainty in `after` is another one or none.
TireCorrelation keep_correlation(const TireFile& before, const TireFile& after);

}  // namespace rollrig::models
