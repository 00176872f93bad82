#pragma once
/// [correlation] of a tire file: how the errors of its calibrated numbers are correlated.

#include <string>
#include <vector>

#include "sim/core/schema.h"

namespace rollrig::models {

struct TireFile;

/// Correlations of numbers that have a standard uncertainty. Numbers that are not listed are independent of all others.
/// Equation  cov(x_i, x_j) = R_ij s_i s_j
/// Symbols   x numbers as the file has them, not their logarithms; s their standard uncertainties (`<key>_sd`);
///           R the matrix
/// Validity  errors that are jointly normal
/// Source    the definition of a correlation
struct TireCorrelation {
  std::vector<std::string> numbers;  // dotted keys of the file: "thermal.heat_capacity_J_per_K", "load_map.0.A0_N"
  std::vector<std::vector<double>> matrix;
};

/// Two numbers of a tire whose errors are correlated, each by the key of a run: "tire.<table>.<key>".
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

/// The table as TOML, empty without numbers. The matrix is written with all digits that it has.
std::string write_correlation(const TireCorrelation& correlation);

/// Correlations as pairs, of the numbers that hold on a rig. A conductance of [thermal.rig.<name>] replaces that of
/// [thermal]; the numbers of other rigs are left out.
std::vector<CorrelatedPair> list_correlated_pairs(const TireFile& tire, const std::string& rig);

/// The correlation of a tire after some of its numbers were identified anew: among these it is `fitted`, between them
/// and others 0, and others keep theirs as far as they still have a standard uncertainty.
TireCorrelation replace_correlation(const TireFile& tire, TireCorrelation fitted);

}  // namespace rollrig::models
