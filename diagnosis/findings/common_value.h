#pragma once
/// Whether several estimates are of one value.

#include <vector>

namespace rollrig::diagnosis {

struct Estimate {
  double value = 0.0;
  double variance = 0.0;  // positive
};

struct CommonValue {
  double mean = 0.0;
  double sd = 0.0;
  double chance = 1.0;  // that estimates of one value differ at least this much; 1 of a single one
};

/// What estimates with independent normal errors say if they are of one value.
/// Equation  mean = sum(x/v) / sum(1/v), sd = sum(1/v)^-1/2; chance that chi2 of n - 1 degrees of freedom is above
///           sum((x - mean)^2 / v)
/// Symbols   n estimates x with variances v
/// Validity  one estimate at least
/// Checked   tests/diagnosis/common_value_test.cpp
CommonValue find_common_value(const std::vector<Estimate>& estimates);

}  // namespace rollrig::diagnosis
